// What a flight says against a constant that its fit held.
#pragma once

#include "ident/estimators/flight_fit.h"

namespace ident {

/// By how much the logs contradict the watched constant `at`, in squared standard deviations: how far one
/// Newton step from the fit moves it when it is free, against the spread of its score over blocks of time. 0
/// where that is rounding.
double contradiction(const Theta& theta, const FlightFit& fit, Eigen::Index at);

}  // namespace ident
