// Vehicles whose rotors stand on a ring and spin in turn.
#pragma once

#include <cmath>
#include <numbers>

#include "ident/model/vehicle.h"

namespace ident::testing {

inline Vehicle ring_of_rotors(int count) {
  Vehicle v;
  for (int n = 0; n < count; ++n) {
    const double angle = std::numbers::pi / count * (2 * n + 1);
    Rotor rotor;
    rotor.r_B = {0.2 * std::cos(angle), 0.2 * std::sin(angle), 0};
    rotor.s = n % 2 == 0 ? 1 : -1;
    v.rotors.push_back(rotor);
  }
  v.parameters = {{"m", {0.12 * count, {}}}, {"kT", {6e-6, {}}},    {"kQ", {1e-7, {}}},
                  {"km", {900, {}}},         {"omega_m", {25, {}}}, {"zeta_m", {0.9, {}}},
                  {"Jxx", {6e-3, {}}},       {"Jyy", {6.4e-3, {}}}, {"Jzz", {1e-2, {}}},
                  {"Jp", {2e-6, {}}}};
  return v;
}

}  // namespace ident::testing
