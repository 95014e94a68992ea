// Sign, range and standard deviation of every number in a vehicle file.
#include "ident/bench/check/consistency_values.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"

namespace ident {
namespace {

/// What vehicles of 10 g to 50 kg have, with a factor of ten to spare on either side: outside it is the unit
/// that is wrong (kT per rpm^2 is 91 times smaller than per (rad/s)^2).
struct PlausibleRange {
  const char* name;
  double low, high;
};
constexpr std::array kPlausible = {
    PlausibleRange{"m", 1e-3, 500.0},      PlausibleRange{"l", 3e-3, 5.0},
    PlausibleRange{"kT", 1e-10, 1e-1},     PlausibleRange{"kQ", 1e-13, 1e-2},
    PlausibleRange{"km", 10.0, 1e4},       PlausibleRange{"omega_m", 0.3, 1e3},
    PlausibleRange{"zeta_m", 0.05, 20.0},  PlausibleRange{"dead_time", 0.0, 0.5},
    PlausibleRange{"Jxx", 1e-8, 100.0},    PlausibleRange{"Jyy", 1e-8, 100.0},
    PlausibleRange{"Jzz", 1e-8, 100.0},    PlausibleRange{"Jp", 0.0, 0.1},
    PlausibleRange{"Omega_0", -5e3, 5e3},  PlausibleRange{"alpha", -0.8, 0.8},
    PlausibleRange{"alpha_opt", 0.0, 0.8}, PlausibleRange{"ki", 1e-5, 10.0},
    PlausibleRange{"kv", 1e-5, 10.0},      PlausibleRange{"R", 1e-4, 100.0},
    PlausibleRange{"I0", 0.0, 50.0},       PlausibleRange{"G", 0.05, 50.0},
    PlausibleRange{"CT", 1e-4, 0.2},       PlausibleRange{"CQ", 1e-6, 0.05},
    PlausibleRange{"Kdx", 0.0, 50.0},      PlausibleRange{"Kdy", 0.0, 50.0},
    PlausibleRange{"Kdz", 0.0, 50.0},      PlausibleRange{"figure_of_merit", 0.02, 1.0}};

bool has_to_be_positive(const std::string& name) {
  const ParameterInfo* info = find_parameter(name);
  const bool moment = name == "Jxx" || name == "Jyy" || name == "Jzz";
  if (moment || (info && info->kind == ParameterKind::positive)) return true;
  return name == "l" || name == "ki" || name == "kv" || name == "R" || name == "G" || name == "CT" ||
         name == "CQ";
}

nlohmann::ordered_json value_json(const std::string& name, const Known& known) {
  nlohmann::ordered_json json = {{name, known.value}};
  if (known.std) json["std"] = *known.std;
  return json;
}

/// The sign that an effect's parameter has to have, and the size beyond which it is not physical.
std::string effect_problem(const std::string& name, double v) {
  const EffectParameter* p = find_effect_parameter(name);
  if (!p) return "";
  const double distance = v - p->null_value;
  if (p->range == Range::positive && distance < 0.0)
    return fmt::format("has the wrong sign: it is at least {}", format_number(p->null_value));
  if (std::fabs(distance) > p->limit)
    return fmt::format("is farther than {} from {}, which no vehicle has", format_number(p->limit),
                       format_number(p->null_value));
  return "";
}

std::string problem(const std::string& name, double v) {
  if (!std::isfinite(v)) return "is no number";
  if (has_to_be_positive(name) && v <= 0.0) return "has to be positive";
  if (name.find('.') != std::string::npos) return effect_problem(name, v);
  for (const PlausibleRange& range : kPlausible)
    if (name == range.name && (v < range.low || v > range.high))
      return fmt::format("is outside {} to {} {}: units?", format_number(range.low),
                         format_number(range.high), parameter_unit(name));
  return "";
}

void check_std(const std::string& name, const Known& known, Consistency& found) {
  if (!known.std) return;
  const double std = *known.std, size = std::fabs(known.value);
  if (!(std > 0.0) || !std::isfinite(std))
    return found.violated(
        "standard deviation of " + name,
        {"bad_std", name + ": a standard deviation has to be positive", value_json(name, known)});
  if (has_to_be_positive(name) && std > size)
    found.doubtful("standard deviation of " + name,
                   {"large_std", fmt::format("{} = {} ± {}: nothing is known of it", name,
                                             format_number(known.value), format_number(std))});
  if (size > 0.0 && std < 1e-5 * size)
    found.doubtful(
        "standard deviation of " + name,
        {"small_std", fmt::format("{} = {} ± {}: no bench measures to {}", name, format_number(known.value),
                                  format_number(std), format_number(std / size, 1))});
}

void check_rotor_axes(const Vehicle& vehicle, Consistency& found) {
  for (std::size_t n = 0; n < vehicle.rotors.size(); ++n)
    if (vehicle.rotors[n].a_B.z() >= 0.0)
      found.violated("thrust axes", {"rotor_pushes_down",
                                     fmt::format("rotor {}: its thrust axis points down (z is down in the "
                                                 "body frame: an upright rotor has axis (0, 0, -1))",
                                                 n + 1),
                                     {{"rotor", n + 1}, {"axis_z", vehicle.rotors[n].a_B.z()}}});
}

}  // namespace

void check_values(const Vehicle& vehicle, Consistency& found) {
  std::size_t fine = 0;
  for (const auto& [name, known] : vehicle.parameters) {
    const std::string wrong = problem(name, known.value);
    if (wrong.empty())
      ++fine;
    else
      found.violated("range of " + name,
                     {"out_of_range", fmt::format("{} = {} {}", name, format_number(known.value), wrong),
                      value_json(name, known)});
    check_std(name, known, found);
  }
  if (fine > 0) found.ok("sign and range", fmt::format("{} of {} values", fine, vehicle.parameters.size()));
  if (vehicle.g < 0.1 || vehicle.g > 30.0)
    found.violated(
        "gravity",
        {"out_of_range", fmt::format("gravity = {} m/s^2", format_number(vehicle.g)), {{"g", vehicle.g}}});
  check_rotor_axes(vehicle, found);
}

}  // namespace ident
