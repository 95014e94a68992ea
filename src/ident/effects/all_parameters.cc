// The list of all constants, put together from the base list and the effects.
#include "ident/effects/all_parameters.h"

#include <algorithm>
#include <map>

#include "ident/core/error.h"
#include "ident/effects/catalogue.h"
#include "ident/model/vehicle.h"

namespace ident {
namespace {

constexpr bool drives(int symbol) {
  return symbol == param::km || symbol == param::Omega_0 || symbol == param::omega_m ||
         symbol == param::zeta_m || symbol == param::dead_time;
}

std::vector<ParameterInfo> collect() {
  using enum ParameterKind;
  std::vector<ParameterInfo> list;
#define IDENT_PARAMETER(symbol, unit, null_value, kind, meaning) \
  list.push_back({#symbol, unit, null_value, kind, meaning, param::symbol, drives(param::symbol)});
#include "ident/model/base_parameters.def"
#undef IDENT_PARAMETER
  for (const EffectEntry& effect : catalogue()) {
    int index = effect.offset;
    for (const EffectParameter& p : effect.parameters) {
      list.push_back({std::string(effect.info.name) + "." + std::string(p.name), std::string(p.unit),
                      p.null_value, real, std::string(effect.info.name), index++, effect.drives});
    }
  }
  return list;
}

const std::vector<ParameterInfo>& registry() {
  static const std::vector<ParameterInfo> list = collect();
  return list;
}

/// Units of constants that the bench finds but the flight model does not use.
const std::map<std::string, std::string, std::less<>>& bench_units() {
  static const std::map<std::string, std::string, std::less<>> units = {{"g", "m/s^2"},
                                                                        {"l", "m"},
                                                                        {"alpha_opt", "rad"},
                                                                        {"ki", "N m/A"},
                                                                        {"kv", "V s/rad"},
                                                                        {"R", "Ohm"},
                                                                        {"I0", "A"},
                                                                        {"G", "-"},
                                                                        {"CT", "-"},
                                                                        {"CQ", "-"},
                                                                        {"figure_of_merit", "-"}};
  return units;
}

}  // namespace

std::span<const ParameterInfo> all_parameters() { return registry(); }

const ParameterInfo* find_parameter(std::string_view name) {
  const auto at = std::ranges::find(registry(), name, &ParameterInfo::name);
  return at == registry().end() ? nullptr : &*at;
}

double default_value(std::string_view name) {
  if (const ParameterInfo* info = find_parameter(name)) return info->null_value;
  throw UsageError("there is no parameter '" + std::string(name) + "'");
}

std::string parameter_unit(std::string_view name) {
  if (const ParameterInfo* info = find_parameter(name)) return info->unit;
  const auto at = bench_units().find(name);
  return at == bench_units().end() ? std::string() : at->second;
}

double Vehicle::value(const std::string& parameter) const {
  const auto at = parameters.find(parameter);
  return at != parameters.end() ? at->second.value : default_value(parameter);
}

}  // namespace ident
