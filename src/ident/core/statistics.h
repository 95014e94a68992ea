// Distributions, robust location and scale, autocorrelation: what estimates and tests are judged with.
#pragma once

#include <span>
#include <vector>

namespace ident {

// Distributions. `p` is a probability, `dof` degrees of freedom (need not be whole; infinite is allowed).

double normal_cdf(double z);
double normal_quantile(double p);
double t_cdf(double t, double dof);
double t_quantile(double p, double dof);
/// Half width of the central 95 % interval in standard deviations: t_quantile(0.975, dof).
double t95(double dof);
double f_cdf(double f, double dof1, double dof2);
double chi2_cdf(double x, double dof);
/// Probability that |t| is at least as large as seen if there is no effect.
double two_sided_p(double t, double dof);

// Samples. Values that are not finite are left out; of an empty sample everything is NaN.

double mean(std::span<const double> x);
/// With the divisor n - 1.
double standard_deviation(std::span<const double> x);
double quantile(std::span<const double> x, double p);
double median(std::span<const double> x);
/// Median absolute deviation from `center`, scaled to the standard deviation of a normal sample.
double mad_scale(std::span<const double> x, double center);
inline double mad_scale(std::span<const double> x) { return mad_scale(x, median(x)); }
double root_mean_square(std::span<const double> x);

/// Location of a sample with outliers: those beyond a cut that grows with the sample are left out.
/// `std` is that of the location (already divided by sqrt(n)), `scale` that of one value.
struct RobustMean {
  double value, std, scale, dof;
  std::size_t used, rejected;
};
/// Needs 2 values for a scale; below 5 values nothing is rejected.
RobustMean robust_mean(std::span<const double> x);

/// How many standard deviations a normal sample of that size hardly ever exceeds: one in twenty samples loses
/// a value by mistake; never fewer than 3.
double outlier_cut(std::size_t sample_size);

/// Variance of a normal distribution cut at +- `cut` standard deviations, relative to the uncut one.
double truncated_variance(double cut);

/// Autocorrelation at lags 0 to max_lag.
std::vector<double> autocorrelation(std::span<const double> x, std::size_t max_lag);

/// r2 = 1 - sum residual^2 / sum (y - mean)^2.
double r_squared(std::span<const double> y, std::span<const double> residual);

}  // namespace ident
