// Commands of an ArduPilot log's motors at the rate of its rate controller, where pulses were logged more
// seldom.
#pragma once

#include "ident/data/log_streams.h"

namespace ident {

/// Adds the stream `motor_commands` (fields `motor[0]` ...): the commands of the motors, 0 to 1 over the
/// range of pulses. Its samples are those of RCOU and, between them, what the demands of the rate controller
/// (RATE: ROut, POut, YOut, AOut) give through the mixer and the thrust curve that the log's parameters
/// state, where no motor saturates. Gains of the demands are fitted to RCOU, and the rest is checked: where
/// it disagrees nothing is added, and `facts["commands"]` says by how much.
void add_ardupilot_commands(LogStreams& log);

}  // namespace ident
