// A vehicle as a part of another YAML file. Only the files of this folder include it.
#pragma once

#include "ident/io/file/yaml_value.h"
#include "ident/io/vehicle/vehicle_file.h"

namespace ident {}  // namespace ident
