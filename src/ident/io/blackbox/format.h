// Reads blackbox files of Betaflight, INAV and Cleanflight (.bbl, .bfl, .txt): every log that a file holds.
#pragma once

#include <string>
#include <string_view>

#include "ident/data/log_streams.h"

namespace ident {

/// Streams of log k: `k:main` (the lines of blackbox_decode's CSV, names and units as there), `k:slow`,
/// `k:gps`, `k:events`. Times count from the first main frame of the first log; a log after a restart of the
/// clock is put behind the one before it. Header lines become parameters (numbers; `motorOutput[0]` for
/// lists) and facts (texts); of later logs only those that differ, as `2:looptime`.
struct BlackboxFormat {
  static bool recognises(std::string_view first);
  static LogStreams read(std::string_view bytes, const std::string& file);
};

}  // namespace ident
