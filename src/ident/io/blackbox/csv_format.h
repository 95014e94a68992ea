// Reads blackbox logs that were turned into CSV, by blackbox_decode or by the Blackbox Explorer.
#pragma once

#include <string>
#include <string_view>

#include "ident/data/log_streams.h"

namespace ident {

/// The stream `1:main` with the columns of the file, as numbers; columns of texts (flags by name) are left
/// out. The Explorer writes the log's header in front, as `"name","value"`: it becomes parameters and facts
/// as of a `.bbl`.
struct BlackboxCsvFormat {
  static bool recognises(std::string_view first);
  static LogStreams read(std::string_view bytes, const std::string& file);
};

}  // namespace ident
