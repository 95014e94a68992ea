// What a fit owes to how measured rotor speeds, its input, were smoothed.
#pragma once

#include "ident/estimators/flight_fit.h"

namespace ident {

/// How far the shared unknowns of a fit move where its input is smoothed less; zero where commands are the
/// input. The fit's covariance knows nothing of it.
Eigen::VectorXd moved_by_rougher_speeds(const FlightRecord& record, const Theta& theta, const FlightFit& fit);

}  // namespace ident
