// Reads vehicle and parameter files.
#include "ident/io/vehicle/vehicle_read.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"
#include "ident/core/parse_number.h"
#include "ident/effects/all_parameters.h"
#include "ident/io/file/read_bytes.h"
#include "ident/io/simulators/simulators.h"
#include "ident/io/vehicle/parameter_names.h"
#include "ident/io/vehicle/vehicle_correlations.h"
#include "ident/io/vehicle/vehicle_yaml.h"
#include "ident/model/parameters.h"

namespace ident {
namespace {

using Words = std::vector<std::string>;

const Words kVehicleKeys = {"name",        "gravity",         "mass",         "command",
                            "rotors",      "layout",          "arm",          "slant_deg",
                            "ground",      "signs",           "parameters",   "propeller_radius",
                            "air_density", "battery_voltage", "correlations", "air"};
const Words kKnownKeys = {"value", "std"};
const Words kRotorKeys = {"position", "axis", "spin"};

/// `0.5`, or `{value: 0.5, std: 0.001}`.
Known read_known(const YamlValue& value) {
  if (!value.is_map()) return {value.number(), {}};
  value.expect_map(kKnownKeys);
  Known known{value.at("value").number(), {}};
  if (!value.has("std")) return known;
  known.std = value.at("std").number();
  if (*known.std <= 0.0)
    value.at("std").fail("has to be positive; leave it out where nothing is known of it");
  return known;
}

[[noreturn]] void given_twice(const YamlValue& where, std::string_view other) {
  where.fail(fmt::format("is given twice: {} says the same", other));
}

CommandRange read_command(const YamlValue& value) {
  static const Words keys = {"min", "max"};
  value.expect_map(keys);
  const CommandRange range{value.at("min").number(), value.at("max").number()};
  if (range.max_us <= range.min_us) value.fail("max has to be above min (pulse widths in us)");
  return range;
}

int read_spin(const YamlValue& value) {
  const std::string spin = value.text();
  if (spin == "ccw") return 1;
  if (spin == "cw") return -1;
  value.fail(fmt::format("'{}' is no spin: ccw or cw, as seen from above", spin));
}

/// Unit thrust axis. A length that is off by rounding is no news, another one is a warning.
Eigen::Vector3d read_axis(const YamlValue& value, Vehicle& vehicle) {
  const auto [x, y, z] = value.vector3();
  Eigen::Vector3d axis(x, y, z);
  const double length = axis.norm();
  if (!(length > 1e-6) || !std::isfinite(length)) value.fail("has no direction");
  if (std::abs(length - 1.0) < 1e-12) return axis;
  if (std::abs(length - 1.0) > 0.01)
    vehicle.warnings.push_back(
        {"axis_normalised", fmt::format("{}:{}: {}: length {:.4g}, taken as a direction", value.file(),
                                        value.line(), value.path(), length)});
  return axis / length;
}

Rotor read_rotor(const YamlValue& value, Vehicle& vehicle) {
  value.expect_map(kRotorKeys);
  const auto [x, y, z] = value.at("position").vector3();
  Rotor rotor{.r_B = {x, y, z}, .s = read_spin(value.at("spin"))};
  if (value.has("axis")) rotor.a_B = read_axis(value.at("axis"), vehicle);
  return rotor;
}

void read_rotors(const YamlValue& file, Vehicle& vehicle) {
  const YamlValue list = file.at("rotors");
  for (const char* other : {"layout", "slant_deg"})
    if (file.has(other)) given_twice(file.at(other), "rotors");
  const std::vector<YamlValue> rotors = list.list();
  if (rotors.empty()) list.fail("names no rotor");
  bool axes_given = false;
  for (const YamlValue& rotor : rotors) {
    vehicle.rotors.push_back(read_rotor(rotor, vehicle));
    axes_given = axes_given || rotor.has("axis");
  }
  if (axes_given && vehicle.has("alpha")) given_twice(file.at("parameters").at("alpha"), "the rotors' axes");
}

void read_layout(const YamlValue& file, Vehicle& vehicle) {
  static const Words layouts = {"plus", "x", "4sp"};
  const YamlValue layout = file.at("layout");
  vehicle.layout = layout.text();
  if (std::ranges::find(layouts, vehicle.layout) == layouts.end())
    layout.fail(fmt::format("'{}' is no layout: plus, x or 4sp; others list their rotors", vehicle.layout));
  if (!vehicle.arm) layout.fail("needs 'arm', the distance from the centre to a hub in m");
  if (file.has("slant_deg")) {
    const YamlValue slant = file.at("slant_deg");
    if (vehicle.layout != "4sp")
      slant.fail("only layout 4sp has a slant; list the rotors with their axes instead");
    if (vehicle.has("alpha")) given_twice(slant, "parameters.alpha");
    Known alpha = read_known(slant);
    constexpr double kRadPerDeg = std::numbers::pi / 180.0;
    alpha.value *= kRadPerDeg;
    if (alpha.std) *alpha.std *= kRadPerDeg;
    vehicle.parameters["alpha"] = alpha;
  }
  vehicle.rotors = layout_rotors(vehicle.layout, *vehicle.arm, slant_angle(vehicle));
}

/// Rotor that `effect.rotor` names, 0 for `all` and where it is absent.
int read_rotor_number(const YamlValue& parameters, const std::string& effect) {
  const std::string key = effect + ".rotor";
  if (!parameters.has(key)) return 0;
  const YamlValue value = parameters.at(key);
  if (value.text() == "all") return 0;
  const double number = value.number();
  if (number < 1 || number > 8 || number != std::floor(number))
    value.fail("has to be a rotor's number, 1 to 8");
  return static_cast<int>(number);
}

void read_parameter(const YamlValue& parameters, const std::string& name, Vehicle& vehicle) {
  const YamlValue value = parameters.at(name);
  const std::string effect(effect_of(name));
  if (names_a_rotor(effect) && name == effect + ".rotor") return;
  if (!is_file_parameter(name))
    value.fail("is no parameter of the model" + did_you_mean(name, file_parameter_names()));
  const int rotor = names_a_rotor(effect) ? read_rotor_number(parameters, effect) : 0;
  if (effect == "rotor_mismatch" && rotor == 0 && name.find('@') == std::string::npos)
    value.fail("needs 'rotor_mismatch.rotor', the number of the rotor");
  const FileParameter inside = to_inside({name, read_known(value), {}}, rotor);
  if (!vehicle.parameters.emplace(inside.name, inside.known).second) given_twice(value, inside.name);
}

void read_parameters(const YamlValue& file, Vehicle& vehicle) {
  if (!file.has("parameters")) return;
  const YamlValue parameters = file.at("parameters");
  parameters.expect_map();
  for (const std::string& name : parameters.keys()) read_parameter(parameters, name, vehicle);
}

/// What has a key of its own as well as a name among the parameters: mass and m, gravity and g, arm and l.
void read_twin(const YamlValue& file, const std::string& key, const std::string& name, Vehicle& vehicle) {
  if (!file.has(key)) return;
  if (vehicle.has(name)) given_twice(file.at("parameters").at(name), key);
  vehicle.parameters[name] = read_known(file.at(key));
}

void read_numbers(const YamlValue& file, Vehicle& vehicle) {
  read_twin(file, "mass", "m", vehicle);
  read_twin(file, "gravity", "g", vehicle);
  read_twin(file, "arm", "l", vehicle);
  if (vehicle.has("g")) vehicle.g = vehicle.parameters.extract("g").mapped().value;
  if (vehicle.has("l")) {
    vehicle.arm = vehicle.value("l");
    if (!vehicle.parameters["l"].std) vehicle.parameters.erase("l");
  }
  if (file.has("command")) vehicle.command = read_command(file.at("command"));
  if (file.has("ground")) vehicle.ground_z = file.at("ground").number();
  if (file.has("propeller_radius")) vehicle.propeller_radius = file.at("propeller_radius").positive_number();
  if (file.has("air_density")) vehicle.air_density = file.at("air_density").positive_number();
  if (file.has("air")) vehicle.air = read_air(file.at("air"));
  if (file.has("battery_voltage")) vehicle.battery_voltage = file.at("battery_voltage").positive_number();
}

Signs read_signs(const YamlValue& value) {
  const std::string word = value.text();
  if (word == "first_principles") return Signs::first_principles;
  if (word == "as_published") return Signs::as_published;
  value.fail(fmt::format("'{}' is no choice of signs: first_principles or as_published", word));
}

void expect_rotor_exists(const YamlValue& file, const Vehicle& vehicle) {
  for (const auto& [name, known] : vehicle.parameters) {
    const std::size_t mark = name.find('@');
    if (mark == std::string::npos || vehicle.rotors.empty()) continue;
    const double number = parse_number(name.substr(mark + 1)).value_or(0.0);
    if (number > static_cast<double>(vehicle.rotors.size()))
      file.at("parameters").fail(fmt::format("{}: the vehicle has {} rotors", name, vehicle.rotors.size()));
  }
}

/// Constants that are estimated as logarithms, and the inertias, have to be positive to compute with.
void expect_computable(const YamlValue& file, const Vehicle& vehicle) {
  for (const auto& [name, known] : vehicle.parameters) {
    const ParameterInfo* info = find_parameter(name);
    const bool moment = name == "Jxx" || name == "Jyy" || name == "Jzz";
    if (!info || known.value > 0.0 || (info->kind != ParameterKind::positive && !moment)) continue;
    const bool is_mass = name == "m" && file.has("mass");
    (is_mass ? file.at("mass") : file.at("parameters").at(name)).fail("has to be positive");
  }
  if (vehicle.g <= 0.0 && file.has("gravity")) file.at("gravity").fail("has to be positive");
}

}  // namespace

AirLevel read_air(const YamlValue& value) {
  const std::string word = value.text();
  if (const auto level = air_level(word)) return *level;
  value.fail(fmt::format("'{}' is no level of the air: {}", word, fmt::join(kAirWords, ", ")));
}

Vehicle read_vehicle(const std::string& path, VehicleUse use) {
  constexpr std::size_t kLargestFile = 16u << 20;
  const std::string text = read_bytes(path, kLargestFile);
  if (const SimulatorFormat* format = recognised_simulator(text))
    return vehicle_of_simulator(*format, text, path);
  return vehicle_from(parse_yaml(text, path), use);
}

Vehicle vehicle_from(const YamlValue& file, VehicleUse use) {
  file.expect_map(kVehicleKeys);
  Vehicle vehicle;
  vehicle.file = file.file();
  if (file.has("name")) vehicle.name = file.at("name").text();
  if (file.has("signs")) vehicle.signs = read_signs(file.at("signs"));
  read_parameters(file, vehicle);
  read_numbers(file, vehicle);
  if (file.has("rotors")) read_rotors(file, vehicle);
  if (file.has("layout")) read_layout(file, vehicle);
  if (file.has("slant_deg") && !file.has("layout")) file.at("slant_deg").fail("needs 'layout: 4sp'");
  read_correlations(file, vehicle);
  expect_rotor_exists(file, vehicle);
  if (use == VehicleUse::computing) expect_computable(file, vehicle);
  return vehicle;
}

}  // namespace ident
