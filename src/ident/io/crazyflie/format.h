// Log of a Crazyflie's memory card as a log format.
#pragma once

#include <string>
#include <string_view>

#include "ident/data/log_streams.h"

namespace ident {

/// Card log, versions 1 and 2 [Bitcraze, crazyflie-firmware usddeck.c and cfusdlog.py]. A stream is an event,
/// `fixedFrequency` among them; its field `time [s]` is since the start of the firmware.
struct CrazyflieFormat {
  static bool recognises(std::string_view first);
  /// Throws InputError where the file is cut within its description of events.
  static LogStreams read(std::string_view bytes, const std::string& file);
};

}  // namespace ident
