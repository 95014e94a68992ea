// Velocities that are off by a constant.
#pragma once

#include "ident/flight/record/flight_record.h"

namespace ident {

/// Takes a constant error out of the velocities of a log (world frame) where its positions show one beyond
/// doubt, and says so (velocity_bias). Positions tell it a hundred times better than flight does, so that it
/// need not be estimated with the model. Without positions nothing is changed.
void take_out_velocity_bias(FlightRecord& record);

}  // namespace ident
