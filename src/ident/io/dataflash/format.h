// ArduPilot DataFlash as log formats: binary and text.
#pragma once

#include <string>
#include <string_view>

#include "ident/data/log_streams.h"

namespace ident {

/// Binary DataFlash (`.bin`) [ArduPilot, AP_Logger/LogStructure.h]. A stream is a message by its name; one of
/// several instances keeps its instance in a column (`I`, `Instance`, `C`). Times count from the start of the
/// autopilot. Damage is passed over to the next message that is known.
struct DataflashFormat {
  static bool recognises(std::string_view first);
  static LogStreams read(std::string_view bytes, const std::string& file);
};

}  // namespace ident
