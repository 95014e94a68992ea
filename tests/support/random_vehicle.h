// Vehicles drawn at random over the whole range of sizes, with constants that fit together.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "ident/core/random.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Mass 0.03 to 5 kg, thrust to weight 1.6 to 5, motors 5 to 80 rad/s with damping 0.4 to 2; layouts 4sp at
/// its own best slant, plus, x, and a hexacopter as a list of rotors.
inline Vehicle random_vehicle(std::uint64_t seed) {
  Random random(seed);
  Vehicle v;
  v.name = "random " + std::to_string(seed);
  const double m = random.log_uniform(0.03, 5.0);
  // Arms follow the size of the body: 0.05 m at 30 g, 0.3 m at 5 kg, give or take 40 %.
  const double arm = std::clamp(0.17 * std::cbrt(m / 0.5) * random.log_uniform(0.7, 1.4), 0.03, 0.5);
  const double radius = arm * random.uniform(0.4, 0.65);
  const double thrust_to_weight = random.log_uniform(1.6, 5.0);
  const double omega_most = 150.0 / radius * random.log_uniform(0.5, 1.1);  // tip speed 75 to 165 m/s
  const int kind = random.below(4);
  const int rotors = kind == 3 ? 6 : 4;
  const double kT = thrust_to_weight * m * 9.81 / rotors / (omega_most * omega_most);
  const double kQ = kT * radius * random.uniform(0.1, 0.25);
  const double alpha = std::atan(2 * kQ / (arm * kT));
  const auto set = [&](const char* name, double value) { v.parameters[name] = {value, {}}; };
  if (kind < 3) {
    v.layout = kind == 0 ? "plus" : kind == 1 ? "x" : "4sp";
    v.arm = arm;
    v.rotors = layout_rotors(v.layout, arm, alpha);
    if (kind == 2) set("alpha", alpha);
  } else {
    for (int n = 0; n < 6; ++n) {
      const double angle = n * 3.14159265358979 / 3;
      Rotor rotor;
      rotor.r_B = {arm * std::cos(angle), arm * std::sin(angle), 0};
      rotor.s = n % 2 ? -1 : 1;
      v.rotors.push_back(rotor);
    }
  }
  // Radius of gyration about a third of the arm; a flat body.
  const double J = m * arm * arm * random.uniform(0.1, 0.25);
  set("m", m), set("kT", kT), set("kQ", kQ);
  set("Jxx", J), set("Jyy", J * random.uniform(0.85, 1.15)), set("Jzz", J * random.uniform(1.5, 1.8));
  set("Jp", J * random.log_uniform(2e-4, 2e-3));
  set("km", omega_most), set("omega_m", random.log_uniform(5, 80)), set("zeta_m", random.log_uniform(0.4, 2));
  set("dead_time", random.below(2) ? random.uniform(0.0, 0.015) : 0.0);
  return v;
}

}  // namespace ident
