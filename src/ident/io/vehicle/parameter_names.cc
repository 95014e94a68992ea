// rotor_mismatch.ratio@2 <-> rotor_mismatch.rotor: 2, ground_effect.radius_sq <-> ground_effect.radius.
#include "ident/io/vehicle/parameter_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "ident/effects/all_parameters.h"
#include "ident/model/parameters.h"

namespace ident {
namespace {

constexpr std::array<std::string_view, 2> kRotorEffects = {"rotor_mismatch", "rotor_tilt"};
constexpr const char* kRadius = "ground_effect.radius";
constexpr const char* kRadiusSquared = "ground_effect.radius_sq";

std::string inside_name(const std::string& name, int rotor) {
  return rotor > 0 ? fmt::format("{}@{}", name, rotor) : name;
}

/// Chain rule for y = r^2; at r = 0 the spread of r itself is all there is.
Known squared(const Known& r) {
  Known y{r.value * r.value, {}};
  if (r.std) y.std = r.value != 0.0 ? 2.0 * std::abs(r.value) * *r.std : *r.std * *r.std;
  return y;
}

Known root(const Known& y) {
  Known r{std::sqrt(y.value), {}};
  if (y.std) r.std = y.value != 0.0 ? *y.std / (2.0 * r.value) : std::sqrt(*y.std);
  return r;
}

bool writable(const Known& known) {
  return std::isfinite(known.value) && (!known.std || (std::isfinite(*known.std) && *known.std > 0.0));
}

/// Rotor numbers that the parameters of an effect carry; 0 for one without a number.
std::set<std::string> rotors_of(std::string_view effect, const std::map<std::string, Known>& parameters) {
  std::set<std::string> rotors;
  for (const auto& [name, known] : parameters)
    if (effect_of(name) == effect) {
      const std::size_t mark = name.find('@');
      rotors.insert(mark == std::string::npos ? "" : name.substr(mark + 1));
    }
  return rotors;
}

}  // namespace

std::string_view effect_of(std::string_view name) {
  const std::size_t dot = name.find('.');
  return dot == std::string_view::npos ? std::string_view() : name.substr(0, dot);
}

bool names_a_rotor(std::string_view effect) {
  return std::ranges::find(kRotorEffects, effect) != kRotorEffects.end();
}

bool is_file_parameter(const std::string& name) {
  if (name == kRadius) return find_parameter(kRadiusSquared) != nullptr || find_parameter(kRadius) != nullptr;
  if (name == kRadiusSquared) return false;
  const bool of_one_rotor = names_a_rotor(effect_of(name)) && find_parameter(name + "@1") != nullptr;
  return of_one_rotor || !parameter_unit(name).empty();
}

std::vector<std::string> file_parameter_names() {
  std::vector<std::string> names;
  for (const ParameterInfo& info : all_parameters()) {
    std::string name = info.name == kRadiusSquared ? kRadius : info.name.substr(0, info.name.find('@'));
    if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  }
  for (const std::string_view effect : kRotorEffects) names.push_back(std::string(effect) + ".rotor");
  return names;
}

FileParameter to_inside(const FileParameter& stated, int rotor) {
  if (stated.name == kRadius && find_parameter(kRadiusSquared))
    return {kRadiusSquared, squared(stated.known), {}};
  const bool numbered = names_a_rotor(effect_of(stated.name)) && stated.name.find('@') == std::string::npos;
  return {numbered ? inside_name(stated.name, rotor) : stated.name, stated.known, {}};
}

std::string in_file(const std::string& inside_name) {
  return inside_name == kRadiusSquared ? kRadius : inside_name;
}

std::vector<FileParameter> to_file(const std::map<std::string, Known>& parameters) {
  std::vector<FileParameter> entries;
  std::set<std::string> named;
  for (const auto& [name, inside] : parameters) {
    const bool is_radius = name == kRadiusSquared;
    const Known known = is_radius ? root(inside) : inside;
    if (!writable(known)) continue;
    const std::string effect(effect_of(name));
    const std::set<std::string> rotors = rotors_of(effect, parameters);
    const bool one_rotor = names_a_rotor(effect) && rotors.size() == 1 && !rotors.begin()->empty();
    if (one_rotor && named.insert(effect).second) entries.push_back({effect + ".rotor", {}, *rotors.begin()});
    entries.push_back({is_radius ? kRadius : one_rotor ? name.substr(0, name.find('@')) : name, known, {}});
  }
  return entries;
}

}  // namespace ident
