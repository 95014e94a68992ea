// A quadrotor X for autopilots in the loop, its rotors in an order of their own.
#pragma once

#include "ident/model/vehicle.h"

namespace ident::testing {

/// 0.8 kg, hovers at half command; rotor 1 rear left, 2 front left, 3 rear right, 4 front right.
inline Vehicle flown_quad() {
  Vehicle v;
  v.name = v.file = "flown";
  const double l = 0.14;
  v.rotors = {{.r_B = {-l, -l, 0}, .s = 1},
              {.r_B = {l, -l, 0}, .s = -1},
              {.r_B = {-l, l, 0}, .s = -1},
              {.r_B = {l, l, 0}, .s = 1}};
  const auto state = [&](const char* name, double value) { v.parameters[name] = {value, {}}; };
  state("m", 0.8), state("km", 1000), state("kT", 0.8 * v.g / 4 / 500 / 500), state("kQ", 0.016 * 7.85e-6);
  state("Jxx", 6e-3), state("Jyy", 6.5e-3), state("Jzz", 1.1e-2), state("Jp", 2e-5);
  state("omega_m", 45), state("zeta_m", 0.9), state("dead_time", 0.003);
  v.command = CommandRange{1000.0, 2000.0};
  v.battery_voltage = 14.8;
  return v;
}

}  // namespace ident::testing
