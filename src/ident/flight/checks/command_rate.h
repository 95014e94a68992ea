// Commands that were logged more seldom than they were flown.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ident/data/sampling.h"
#include "ident/flight/record/flight_record.h"
#include "ident/result/result.h"

namespace ident {

/// Whether the commands of a log are so far apart that they leave open what the motors did in between: below
/// 49 Hz.
bool commands_are_seldom(const FlightLog& log);

/// Whether new commands come less often than new rates: a controller that reads these went on in between, or
/// is slower than a multirotor's are.
bool commands_are_rarer_than_rates(const FlightLog& log);

/// Time between samples of what drives the motors, commands or measured speeds, s: of the log where it is
/// longest.
double input_interval(const FlightRecord& record, std::span<const FlightLog> logs);

/// Warning `seldom_commands`, or `seldom_speeds` where these are the input, of the log where that comes most
/// seldom: rows come often enough, but that does not.
std::optional<Warning> seldom_input(const FlightRecord& record, std::span<const FlightLog> logs);

/// Time between commands, s, of a log where these are seldom and rough, so that what was flown in between is
/// not to be told from what was logged.
std::optional<double> hides_motion(const FlightRecord& record, std::span<const FlightLog> logs);

/// A controller goes on between commands. Where these are seldom, motors do not count as known; where they
/// are rough as well, or rotors seem to turn before them, which shows that there were others, neither do
/// moments of inertia, nor an offset of the command that such logs ask for, with what goes with it. Up to 110
/// Hz for commands that are rough and come after what rotors do.
void doubt_seldom_commands(Result& result, const FlightRecord& record, std::span<const FlightLog> logs);

}  // namespace ident
