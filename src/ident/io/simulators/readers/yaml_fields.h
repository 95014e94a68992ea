// All numbers of a YAML or JSON file with their places, named by their way from the root: "motor1.position".
#pragma once

#include <string>

#include "ident/io/simulators/fields.h"

namespace ident {

/// Reads through yaml-cpp (JSON is YAML, and `#` comments are allowed). A list of numbers, nested or not, is
/// one field. `inside` names a mapping that is entered where the root has it. Throws InputError.
Fields yaml_fields(const std::string& text, const std::string& file, const std::string& inside = "");

/// Whether a text is a YAML or JSON mapping that has all these keys, at its root or inside `inside`.
bool yaml_has_keys(std::string_view text, std::initializer_list<const char*> keys,
                   const std::string& inside = "");

}  // namespace ident
