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

/// When the commands of a log change, s, where they are held for about a long step of an estimator
/// (`kLongStep`) or more in between; empty where they change more often.
std::vector<double> command_jumps(const FlightLog& log);

/// The history with commands that go along a line from one to the next, in so many steps.
std::vector<HeldCommand> commands_along_lines(const FlightLog& log, double from, double to, int steps);

}  // namespace ident
