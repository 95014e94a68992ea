// What a flight says against a constant that its fit held, and whether one that it freed is there.
#pragma once

#include <string>

#include "ident/flight/fit/fit.h"

namespace ident {

/// By how much the logs contradict the watched constant `at`, in squared standard deviations: how far one
/// Newton step from the fit moves it when it is free, against the spread of its score over blocks of time. 0
/// where that is rounding.
double contradiction(const Theta& theta, const FlightFit& fit, Eigen::Index at);

/// Whether a constant that is free may stand where it began by chance, within so many deviations. Of speeds
/// that nobody measured the flight tells Omega_0/km and Jp km only.
bool may_be_nothing(const Theta& theta, const FlightFit& fit, const std::string& name, double deviations);

}  // namespace ident
