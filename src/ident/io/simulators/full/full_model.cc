// One list of constants for the C and the CasADi text, so that both have the same names.
#include "ident/io/simulators/full/full_model.h"

#include <fmt/format.h>

#include "ident/effects/all_parameters.h"
#include "ident/io/simulators/entries.h"

namespace ident {
namespace {

// Effects whose equations the programs hold; what else there is folds into mass, axes, ratios or lags, or is
// lost.
constexpr const char* kEffects[] = {"Kdx",
                                    "Kdy",
                                    "Kdz",
                                    "rotor_drag.kd",
                                    "parasitic_drag.C",
                                    "translational_lift.kh",
                                    "axial_inflow.kz",
                                    "blade_flapping.kf",
                                    "thrust_curve.c",
                                    "thrust_curve.offset",
                                    "ground_effect.radius_sq"};
constexpr const char* kBase[] = {"m",  "Jxx", "Jyy", "Jzz",     "Jxy",     "Jxz",    "Jyz",      "Jp",
                                 "kT", "kQ",  "km",  "Omega_0", "omega_m", "zeta_m", "dead_time"};

std::string identifier(std::string name) {
  for (char& c : name)
    if (c == '.') c = '_';
  return name;
}

}  // namespace

Capacity full_model_capacity() {
  Capacity holds{.each_rotor = true,
                 .motor = Capacity::Motor::full,
                 .up_and_down = true,
                 .dead_time = true,
                 .idle_speed = true,
                 .rotor_momentum = true,
                 .as_published = true,
                 .ground = true};
  holds.constants.insert(std::begin(kEffects), std::end(kEffects));
  holds.needs = {"km", "omega_m"};
  return holds;
}

std::vector<Value> full_model_values(const Vehicle& v) {
  std::vector<Value> out = {{"g", {v.g}, "m/s^2", "gravity"},
                            {"ground_z", {v.ground_z}, "m", "ground, down"}};
  const auto add = [&](const std::string& name, double absent) {
    out.push_back({identifier(name), {v.has(name) ? v.value(name) : absent}, parameter_unit(name), name});
  };
  for (const char* name : kBase) add(name, std::string_view(name) == "zeta_m" ? 1.0 : 0.0);
  for (const char* axis : {"cg_offset.x", "cg_offset.y", "cg_offset.z"}) add(axis, 0.0);
  add("motor_asymmetry.ratio", 1.0);
  for (const char* name : kEffects) add(name, 0.0);
  out.push_back({"reaction_sign", {v.signs == Signs::first_principles ? 1.0 : -1.0}, "-", "signs"});
  std::vector<double> r, a, s, ratio;
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    const Rotor& rotor = v.rotors[n];
    r.insert(r.end(), {rotor.r_B.x(), rotor.r_B.y(), rotor.r_B.z()}),
        a.insert(a.end(), {rotor.a_B.x(), rotor.a_B.y(), rotor.a_B.z()});
    s.push_back(rotor.s), ratio.push_back(rotor_ratio(v, n));
  }
  out.push_back({"rotor_r", r, "m", "hubs"});
  out.push_back({"rotor_a", a, "-", "thrust axes"});
  out.push_back({"rotor_s", s, "-", "spins, 1 counter-clockwise from above"});
  out.push_back({"rotor_ratio", ratio, "-", "kT and kQ of a rotor over the vehicle's"});
  return out;
}

bool is_of_rotors(const Value& value) {
  return value.name.starts_with("rotor_") && value.of != "rotor_drag.kd";
}

std::vector<std::string> full_model_remarks(const Vehicle& whole) {
  if (motor_lags(whole).dead_time > 0)
    return {"dead_time is a number in the file: delay the commands by it before the call"};
  return {};
}

}  // namespace ident
