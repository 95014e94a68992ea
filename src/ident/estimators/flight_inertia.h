// Whether a body can have the inertia that flight shows.
#pragma once

#include "ident/core/result.h"
#include "ident/estimators/flight_fit.h"

namespace ident {

/// Warns (`triangle_inequality`) where one moment of inertia exceeds the sum of the other two, which no body
/// has, and by how many standard deviations.
void warn_of_inertia(Result& result, const Theta& theta, const FlightFit& fit);

}  // namespace ident
