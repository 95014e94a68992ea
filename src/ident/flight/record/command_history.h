// Commands of a log as the motors are taken to have got them.
#pragma once

#include <vector>

#include "ident/data/flight_log.h"
#include "ident/model/motor.h"

namespace ident {

/// The commands of each rotor over these times (s), held from row to row; before and after, the nearest.
/// Where some rows of an otherwise regular log are lost, the commands that went with them are taken from the
/// line between those before and after.
std::vector<HeldCommand> command_history(const FlightLog& log, double from, double to);

/// The same as if commands went on from one to the next in so many steps along a line.
std::vector<HeldCommand> commands_along_lines(const FlightLog& log, double from, double to, int steps);

}  // namespace ident
