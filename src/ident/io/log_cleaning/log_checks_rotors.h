// What rotor speeds and commands say about each other.
#pragma once

#include "ident/io/log_cleaning/log_checks.h"

namespace ident {

/// Rotor speeds as sizes (warning `rotor_speed_sign` where some were negative), short drop-outs to zero as
/// not sampled (`rotor_speed_dropouts`), and none at all where one of them never changes (`constant_signal`).
void check_rotor_speeds(FlightLog& log, Components Omega);

/// Warns of a command that never changes beside the speed of its rotor that does (`constant_command`); where
/// the speeds of all rotors are known in most rows, they serve as input in place of the commands.
void check_commands(FlightLog& log);

}  // namespace ident
