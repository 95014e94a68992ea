// Commands that were logged more seldom than they were flown.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ident/core/result.h"
#include "ident/estimators/flight_record.h"

namespace ident {

/// Median time from one sample of a group of columns to the next, s: from row to row where it was sampled
/// there, and from change to change where its columns change in the same rows and hold in between. NaN
/// without two.
double time_between(const std::vector<double>& t, std::span<const std::vector<double>> columns);

/// Whether the commands of a log are so far apart that they leave open what the motors did in between: below
/// 49 Hz.
bool commands_are_seldom(const FlightLog& log);

/// Warning `seldom_commands`, or `seldom_speeds` where these are the input: rows come often enough, but that
/// does not. Of the log where it is furthest apart.
std::optional<Warning> seldom_input(const FlightRecord& record, std::span<const FlightLog> logs);

/// By how much commands change from one to the next, of what they change over 25 of them: 1 for noise, 0 for
/// what is smooth.
double roughness(const FlightLog& log);

/// Time between commands, s, where these are seldom and rough, so that what was flown in between is not to be
/// told from what was logged: of the log where they are furthest apart.
std::optional<double> hides_motion(const FlightRecord& record, std::span<const FlightLog> logs);

/// A controller goes on between commands. Where these are seldom, or rotors seem to turn before them, which
/// shows that there were others, motors do not count as known; where both is so, or either and commands are
/// rough, neither do moments of inertia, nor an offset of the command that such logs ask for, with what goes
/// with it.
void doubt_seldom_commands(Result& result, const FlightRecord& record, std::span<const FlightLog> logs);

}  // namespace ident
