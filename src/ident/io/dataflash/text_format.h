// ArduPilot DataFlash as text (`.log`).
#pragma once

#include <string>
#include <string_view>

#include "ident/data/log_streams.h"

namespace ident {

/// The same messages as lines of text, `IMU, 123, 0.1, ...`, with the scales of their letters applied. Lines
/// before the first FMT line are passed over.
struct DataflashTextFormat {
  static bool recognises(std::string_view first);
  static LogStreams read(std::string_view bytes, const std::string& file);
};

}  // namespace ident
