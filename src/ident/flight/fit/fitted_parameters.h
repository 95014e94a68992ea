// What a fit says of its constants, shared by refinement and diagnosis: values, what they go with, and
// whether that agrees with what was known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// The estimates of a fit as parameters of a result, in the order of the constants; watched ones, which come
/// last, are left out.
std::vector<Parameter> flight_parameters(const Theta& theta, const FlightFit& fit, const std::string& source);

/// Correlation of those estimates, from the covariance of the unknowns. What moves as a product with another
/// constant (a payload's place) is left out.
Correlation flight_correlation(const Theta& theta, const Eigen::MatrixXd& covariance);

/// What the data tell only in combination, in words ("kT and km only as kT km^2").
std::vector<std::string> combinations(const Theta& theta, const FlightFit& fit,
                                      const std::vector<Parameter>& parameters);

/// Whether flight says another value than was given beforehand, by more than 3 standard deviations.
bool disagrees(const Parameter& p);

/// Warns of those that do; `advice`: what else it may be.
void warn_of_disagreement(Result& result, std::string_view advice);

}  // namespace ident
