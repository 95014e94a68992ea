// Commands of motors that a log states more often than it logged them.
#pragma once

#include "ident/data/log_streams.h"

namespace ident {

/// Adds the stream `motor_commands` where demands of a controller were logged more often than motors, and the
/// log states the way from the one to the other.
void add_rebuilt_commands(LogStreams& log);

}  // namespace ident
