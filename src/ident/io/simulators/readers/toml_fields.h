// All numbers of a TOML file with their places, named by their way from the root: "cf2x.mass".
#pragma once

#include <string>
#include <vector>

#include "ident/io/simulators/fields.h"

namespace ident {

/// Reads through toml++. A list of numbers, nested or not, is one field. Throws InputError.
Fields toml_fields(const std::string& text, const std::string& file);

/// Names of the tables at the root.
std::vector<std::string> toml_tables(const std::string& text, const std::string& file);

}  // namespace ident
