// Quantiles that detection limits need: of chi-squared, central and not.
#pragma once

namespace withheld {

double chi_squared_upper(double x, double freedom);  // P(X > x)
double noncentral_upper(double x, double freedom, double noncentrality);

// The noncentrality at which a test of level `alpha` on `freedom` parameters has the wanted power.
double noncentrality_for(double freedom, double alpha, double power);

}  // namespace withheld
