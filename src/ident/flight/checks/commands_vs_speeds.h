// Do the rotors of a log turn as its commands say?
#pragma once

#include "ident/data/flight_log.h"

namespace ident {

/// Whether no rotor's speed follows any command of the log, of those rotors whose speed changes by much more
/// than its noise: then commands or speeds are not what they are said to be. A rotor that follows the command
/// of another one is of a wrong motor order, which is for another test.
bool commands_contradict_speeds(const FlightLog& log);

}  // namespace ident
