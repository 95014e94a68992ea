// What a fit owes to how measured rotor speeds, its input, were smoothed.
#pragma once

#include "ident/estimators/flight_fit.h"

namespace ident {

/// Whether measured speeds are the input and have noise that was taken off.
bool has_noisy_input(const FlightRecord& record);

/// How far the shared unknowns of a fit move where its input is smoothed less; zero where commands are the
/// input. The fit's covariance knows nothing of it.
Eigen::VectorXd moved_by_rougher_speeds(const FlightRecord& record, const Theta& theta, const FlightFit& fit);

}  // namespace ident
