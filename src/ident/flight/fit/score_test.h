// Score test of a constant that a fit held, and whether a freed constant may be nothing.
#pragma once

#include <string>

#include "ident/flight/fit/fit.h"

namespace ident {

/// Score statistic of the watched constant `at`, in squared standard deviations: the Newton step that it
/// makes when it is free, against the spread of its score over blocks of time. 0 where the step is rounding.
double contradiction(const Theta& theta, const FlightFit& fit, Eigen::Index at);

/// Whether a free constant is within so many standard deviations of its start value. Without measured speeds
/// a flight determines Omega_0/km and Jp km only.
bool may_be_nothing(const Theta& theta, const FlightFit& fit, const std::string& name, double deviations);

}  // namespace ident
