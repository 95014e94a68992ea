// Names, units and places of all constants of the flight model: the base ones and those of the effects.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ident/model/parameters.h"

namespace ident {

/// One constant of the model. `index` is its place in the model's parameter vector.
struct ParameterInfo {
  std::string name;  ///< kT, or effect.parameter
  std::string unit;
  double null_value = 0.0;  ///< default; for an effect the value at which it is absent
  ParameterKind kind = ParameterKind::real;
  std::string meaning;
  int index = 0;
  bool drives = false;  ///< acts on how rotors turn for their commands
};

/// Every constant, in the order of the parameter vector.
std::span<const ParameterInfo> all_parameters();

/// Entry of that name, or nullptr.
const ParameterInfo* find_parameter(std::string_view name);

/// Default of a constant; throws UsageError when there is no such name.
double default_value(std::string_view name);

/// Unit of a constant of the model, of the bench (`R`, `CT`, ...) or of an effect; empty when unknown.
std::string parameter_unit(std::string_view name);

}  // namespace ident
