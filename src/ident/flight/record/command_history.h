// The commands of a log over time, as the motors received them.
#pragma once

#include <vector>

#include "ident/data/flight_log.h"
#include "ident/model/motor.h"

namespace ident {

/// The commands of each rotor over these times (s), held from row to row; before and after, the nearest.
/// Where single rows of a regular log are lost, their commands are taken from the line between those before
/// and after.
std::vector<HeldCommand> command_history(const FlightLog& log, double from, double to);

/// The same with commands that go along a line from one to the next, in so many steps.
std::vector<HeldCommand> commands_along_lines(const FlightLog& log, double from, double to, int steps);

}  // namespace ident
