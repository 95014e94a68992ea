// A vehicle as a part of another YAML file. Only the files of this folder include it.
#pragma once

#include "ident/io/file/yaml_value.h"
#include "ident/io/vehicle/vehicle_file.h"

namespace ident {

/// Same as `read_vehicle`, from a mapping.
Vehicle vehicle_from(const YamlValue& mapping, VehicleUse use = VehicleUse::computing);

/// A word as a double-quoted YAML scalar.
std::string quoted(const std::string& text);

}  // namespace ident
