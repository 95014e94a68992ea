// One line for each autopilot.
#include "ident/io/rebuild/rebuilt_commands.h"

#include "ident/io/rebuild/ardupilot_commands.h"
#include "ident/io/rebuild/px4_commands.h"

namespace ident {

void add_rebuilt_commands(LogStreams& log) {
  add_px4_commands(log);
  add_ardupilot_commands(log);
}

}  // namespace ident
