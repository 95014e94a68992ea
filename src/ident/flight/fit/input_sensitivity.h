// Sensitivity of a fit to its input: to the smoothing of measured rotor speeds, and to their time.
#pragma once

#include "ident/flight/fit/fit.h"

namespace ident {

/// Whether measured speeds are the input and noise was removed from them.
bool has_noisy_input(const FlightRecord& record);

/// Step of the shared unknowns when the input is smoothed less; zero where commands are the input. The
/// covariance of the fit does not contain it.
Eigen::VectorXd moved_by_rougher_speeds(const FlightRecord& record, const Theta& theta, const FlightFit& fit);

/// The same when the times of the commands are uncertain by so many seconds: a free dead time is off by as
/// much.
Eigen::VectorXd moved_by_time(double seconds, const Theta& theta, const FlightFit& fit);

}  // namespace ident
