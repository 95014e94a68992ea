// Vehicles whose rotors stand on a ring and spin in turn.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "ident/model/vehicle.h"

namespace ident::testing {

/// Rotors on a ring of that radius, m, that spin in turn; none ahead.
inline std::vector<Rotor> ring(int count, double radius) {
  std::vector<Rotor> rotors;
  for (int n = 0; n < count; ++n) {
    const double angle = std::numbers::pi / count * (2 * n + 1);
    rotors.push_back(
        {.r_B = {radius * std::cos(angle), radius * std::sin(angle), 0}, .s = n % 2 == 0 ? 1 : -1});
  }
  return rotors;
}

inline Vehicle ring_of_rotors(int count) {
  Vehicle v;
  v.rotors = ring(count, 0.2);
  v.parameters = {{"m", {0.12 * count, {}}}, {"kT", {6e-6, {}}},    {"kQ", {1e-7, {}}},
                  {"km", {900, {}}},         {"omega_m", {25, {}}}, {"zeta_m", {0.9, {}}},
                  {"Jxx", {6e-3, {}}},       {"Jyy", {6.4e-3, {}}}, {"Jzz", {1e-2, {}}},
                  {"Jp", {2e-6, {}}}};
  return v;
}

}  // namespace ident::testing
