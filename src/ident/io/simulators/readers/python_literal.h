// The dictionary literal of a Python parameter file, with numpy arrays and simple arithmetic, and places of
// its values. Not Python: a subset that parameter files use.
#pragma once

#include <string>
#include <string_view>

#include "ident/io/simulators/fields.h"

namespace ident {

/// Fields of `NAME = {...}`, nested ones as "rotor_pos.r1". Numbers, names assigned before, + - * / **,
/// parentheses, lists, tuples, np.array, np.sqrt, np.sin, np.cos, np.deg2rad, np.pi. Throws InputError with
/// the line of what is something else.
Fields python_literal(const std::string& text, const std::string& file, const std::string& name);

/// Whether the text assigns a dictionary to the name.
bool assigns_dictionary(std::string_view text, std::string_view name);

}  // namespace ident
