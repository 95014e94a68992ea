// A simulator's file states values without deviations. Its constants count as known to a share of
// themselves: directions that the logs do not determine then stay at what the file says.
#pragma once

#include "ident/model/vehicle.h"

namespace ident {

/// The vehicle with such deviations; one that states any deviation is left as it is. A lag of first order
/// stays one.
Vehicle vaguely_stated(Vehicle vehicle);

}  // namespace ident
