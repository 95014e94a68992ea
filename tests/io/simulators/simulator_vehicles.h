// Vehicles for the tests of simulators' files.
#pragma once

#include <string>
#include <vector>

#include "ident/effects/catalogue.h"
#include "ident/model/vehicle.h"

namespace ident::test {

/// A quadrotor X of 0.7 kg, hubs 20 mm above its centre of gravity; nothing is equal by chance.
inline Vehicle plain_quadrotor() {
  Vehicle v;
  v.name = "falcon", v.file = "falcon.yaml";
  v.g = 9.80665;
  const double x = 0.13, y = 0.11, z = -0.02;
  for (const auto& [sx, sy, spin] : {std::tuple(1, 1, 1), {1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}})
    v.rotors.push_back({.r_B = {sx * x, sy * y, z}, .s = spin});
  v.parameters = {{"m", {0.7, 0.002}},      {"Jxx", {3.1e-3, 1e-4}},  {"Jyy", {3.7e-3, 1e-4}},
                  {"Jzz", {5.9e-3, 2e-4}},  {"kT", {6.1e-6, 1e-7}},   {"kQ", {1.1e-7, 3e-9}},
                  {"km", {780.0, 4.0}},     {"omega_m", {61.0, 2.0}}, {"zeta_m", {0.93, 0.05}},
                  {"Omega_0", {43.0, 1.0}}, {"Jp", {4.7e-6, 1e-7}}};
  v.correlation.names = {"m", "kT"};
  v.correlation.matrix = Eigen::Matrix2d{{1.0, 0.6}, {0.6, 1.0}};
  return v;
}

/// The same with one parameter of an effect at a typical distance from its null value.
inline Vehicle with_effect(Vehicle v, const EffectEntry& effect, const EffectParameter& parameter) {
  v.parameters[std::string(effect.info.name) + "." + std::string(parameter.name)] = {
      parameter.null_value + parameter.typical, {}};
  v.propeller_radius = 0.1;
  return v;
}

/// The plain one, and one for each parameter of each effect of at most four rotors, and one with many at
/// once.
inline std::vector<Vehicle> vehicles_with_effects() {
  std::vector<Vehicle> list = {plain_quadrotor()};
  Vehicle many = plain_quadrotor();
  for (const EffectEntry& effect : catalogue())
    for (const EffectParameter& parameter : effect.parameters) {
      const std::size_t mark = parameter.name.find('@');
      if (mark != std::string_view::npos && parameter.name[mark + 1] > '4') continue;
      list.push_back(with_effect(plain_quadrotor(), effect, parameter));
      many = with_effect(many, effect, parameter);
    }
  list.push_back(many);
  for (const double scale : {0.05, 20.0}) {  // 35 g and 14 kg
    Vehicle v = many;
    for (const char* name : {"m", "kT", "kQ"}) v.parameters[name].value *= scale;
    for (const char* name : {"Jxx", "Jyy", "Jzz", "Jp"}) v.parameters[name].value *= scale * scale;
    if (scale < 1)  // sizes for 0.5 kg, more than all of the inertia here
      for (const char* name :
           {"gyroscopic.Jp", "products_of_inertia.Jxy", "products_of_inertia.Jxz", "products_of_inertia.Jyz"})
        v.parameters.erase(name);
    v.parameters["Jxy"] = {0.02 * v.value("Jxx"), {}};
    list.push_back(v);
  }
  return list;
}

}  // namespace ident::test
