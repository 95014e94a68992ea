// Reads map files.
#pragma once

#include "ident/io/log/read_flight_log.h"

namespace ident {

/// Reads a map (YAML: columns, frames, windows). Throws InputError.
LogMap read_log_map(const std::string& path);

}  // namespace ident
