// What was flown, as a flight log: each row the readings and the commands that hold from then on.
#pragma once

#include <span>

#include "ident/data/flight_log.h"
#include "ident/fly/served_vehicle.h"

namespace ident {

/// Adds a row; `delta` as it reaches the motors.
void add_row(FlightLog& log, const Readings& readings, std::span<const double> delta);

}  // namespace ident
