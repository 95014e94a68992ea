// Kinds and places of the base constants of the flight model.
#pragma once

namespace ident {

enum class ParameterKind { positive, real, inertia };

namespace param {
/// Places of the base constants in the parameter vector.
enum Index : int {
#define IDENT_PARAMETER(symbol, unit, null_value, kind, meaning) symbol,
#include "ident/model/base_parameters.def"
#undef IDENT_PARAMETER
  base_count
};
}  // namespace param

}  // namespace ident
