// Commands of a PX4 log's motors at the rate of its setpoints, where the motors were logged more seldom.
#pragma once

#include "ident/data/log_streams.h"

namespace ident {

/// Adds the stream `motor_commands` (fields `motor[0]` ...): the commands of the outputs, 0 to 1, THR_MDL_FAC
/// inverted. Its samples are those of actuator_motors and, between them, what the setpoints of torque and
/// thrust give through the allocation that the log's parameters state, where no motor saturates. That is
/// checked against the samples of actuator_motors; where it disagrees these alone are used, and
/// `facts["commands"]` says by how much. Without actuator_motors nothing is added.
void add_px4_commands(LogStreams& log);

}  // namespace ident
