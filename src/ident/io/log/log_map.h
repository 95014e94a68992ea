// Reads map files.
#pragma once

#include "ident/io/log/read_flight_log.h"

namespace ident {

/// Reads a map (YAML: columns, frames, windows). Throws InputError.
LogMap read_log_map(const std::string& path);

/// The same from text; `name` stands for the file in messages.
LogMap parse_log_map(const std::string& text, const std::string& name);

}  // namespace ident
