// The lines of a map: which column is which signal.
#pragma once

#include "ident/io/file/yaml_value.h"
#include "ident/io/log/read_flight_log.h"

namespace ident {

/// Reads the mapping `columns` into `map`. A key with `{n}` is a line for each rotor; `{n}` and `{n-1}` in it
/// are then its number. A list holds alternatives. Throws InputError.
void read_mapped_columns(const YamlValue& columns, LogMap& map);

}  // namespace ident
