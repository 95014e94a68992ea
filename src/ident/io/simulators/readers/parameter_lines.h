// Parameter files of autopilots, one parameter a line: QGroundControl's, airframe scripts, and NAME VALUE.
#pragma once

#include <string>
#include <string_view>

#include "ident/io/simulators/fields.h"

namespace ident {

/// `1 1 SIH_MASS 1.0 9`, `param set-default SIH_MASS 1.0`, `SIH_MASS 1.0`, `SIH_MASS,1.0`; `#` starts a
/// comment. Of a parameter that is set twice the last counts. Throws InputError where a value is no number.
Fields parameter_lines(const std::string& text, const std::string& file);

/// Whether a line sets this parameter.
bool sets_parameter(std::string_view text, std::string_view name);

}  // namespace ident
