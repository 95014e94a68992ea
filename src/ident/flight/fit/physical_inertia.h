// Whether a body can have the estimated inertia, and the nearest inertia that a body can have.
#pragma once

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// Warns (`triangle_inequality`) where one moment of inertia exceeds the sum of the other two, which no body
/// has, and by how many standard deviations.
void warn_of_inertia(Result& result, const Theta& theta, const FlightFit& fit);

/// The unknowns nearest to those of the fit, in the metric of its information, with the inertia of a body:
///
///   S = tr(J)/2 1 - J  positive semidefinite                     (1)  [Wensing, Kim, Slotine 2018]
///
/// Its log-Cholesky factors would keep to that as well, but end at minus infinity for a flat body, which
/// multirotors nearly are. The fit's own unknowns where (1) holds, and where the vehicle as stated breaks it:
/// whoever states that wants it back.
Eigen::VectorXd nearest_body(const Theta& theta, const FlightFit& fit);

}  // namespace ident
