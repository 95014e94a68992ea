// Motors that are off in flight: they coast, are braked or stand still, and do not follow their command.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/flight/refine.h"
#include "ident/model/vehicle.h"

namespace ident {

/// The logs with those rows `left_out` in which a motor is given nothing (a command of 0) for 10 ms or
/// longer, until the stated dead time later. None where no log has such rows in flight; empty where hardly
/// any flight would be left of one.
std::optional<std::vector<FlightLog>> without_undriven(const Vehicle& vehicle,
                                                       std::span<const FlightLog> logs);

/// `ident flightlog --refine`. Throws DataError when the logs hold nothing to estimate from. Rows in which a
/// motor is off are not used where the rest contradicts them (`not_driven`).
Result refine_flight(const Vehicle& vehicle, std::span<const FlightLog> logs,
                     const RefineOptions& options = {});

}  // namespace ident
