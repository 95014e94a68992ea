// Estimates of a fit as parameters of a result, shared by refinement and diagnosis: values, correlations, and
// whether they agree with the priors.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// The estimates in the order of the constants. Watched ones, which come last, are left out.
std::vector<Parameter> flight_parameters(const Theta& theta, const FlightFit& fit, const std::string& source);

/// Correlation of those estimates, from the covariance of the unknowns. Constants that move as a product with
/// another one (the place of a payload) are left out.
Correlation flight_correlation(const Theta& theta, const Eigen::VectorXd& u,
                               const Eigen::MatrixXd& covariance);

/// Combinations that the data determine, in words ("kT and km only as kT km^2").
std::vector<std::string> combinations(const Theta& theta, const FlightFit& fit,
                                      const std::vector<Parameter>& parameters);

/// Whether the flight contradicts the prior by more than 3 standard deviations.
bool disagrees(const Parameter& p);

/// Warns of the constants that do; `advice`: what else it may be.
void warn_of_disagreement(Result& result, std::string_view advice);

}  // namespace ident
