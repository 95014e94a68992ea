// What a fit owes to how its input was read: how measured rotor speeds were smoothed, and at which time.
#pragma once

#include "ident/flight/fit/fit.h"

namespace ident {

/// Whether measured speeds are the input and have noise that was taken off.
bool has_noisy_input(const FlightRecord& record);

/// How far the shared unknowns of a fit move where its input is smoothed less; zero where commands are the
/// input. The fit's covariance knows nothing of it.
Eigen::VectorXd moved_by_rougher_speeds(const FlightRecord& record, const Theta& theta, const FlightFit& fit);

/// The same where it is not known within so many seconds when commands come: a free dead time is off by as
/// much.
Eigen::VectorXd moved_by_time(double seconds, const Theta& theta, const FlightFit& fit);

}  // namespace ident
