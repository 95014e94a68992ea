// A small quadrotor, what a bench knows of it, and its flights.
#pragma once

#include <array>
#include <cmath>

#include "ident/core/random.h"
#include "ident/sim/simulate.h"

namespace ident::testing {

inline Vehicle quad(double dead_time = 0.0047) {
  Vehicle v;
  v.rotors.clear();
  const double l = 0.1;
  v.rotors.push_back({.r_B = {l, 0, 0}, .s = 1}), v.rotors.push_back({.r_B = {0, -l, 0}, .s = -1});
  v.rotors.push_back({.r_B = {-l, 0, 0}, .s = 1}), v.rotors.push_back({.r_B = {0, l, 0}, .s = -1});
  const auto state = [&](const char* name, double value) { v.parameters[name] = {value, {}}; };
  state("m", 0.25), state("kT", 6.9e-7), state("kQ", 4.4e-9), state("km", 1800), state("omega_m", 22);
  state("zeta_m", 0.8), state("Jxx", 5.2e-4), state("Jyy", 5.4e-4), state("Jzz", 9.0e-4), state("Jp", 7e-6);
  state("dead_time", dead_time);
  return v;
}

/// Each constant known to 8 %, the dead time to 1 ms.
inline Vehicle known(Vehicle v) {
  for (auto& [name, k] : v.parameters) k.std = name == "m" ? 0.002 * k.value : 0.08 * k.value;
  v.parameters["dead_time"].std = 0.001;
  return v;
}

inline FlightLog flight(const Vehicle& v, double rate, std::uint64_t seed, double seconds = 40.0) {
  SimulationOptions options;
  options.rate = rate, options.seed = seed, options.duration = seconds;
  return simulate_flight(v, options).log;
}

/// Constant commands and what sensors show of a vehicle that does not move; its centre of gravity lies `x` m
/// ahead of the origin.
inline FlightLog hover(const Vehicle& v, double seconds, double x = 0.0) {
  FlightLog log = flight(v, 250, 5, seconds);
  const double quarter = v.value("m") * v.g / 4, lever = x / v.rotors[0].r_B[0];
  const std::array thrust{quarter * (1 + lever), quarter, quarter * (1 - lever), quarter};
  for (std::size_t n = 0; n < log.delta.size(); ++n)
    log.delta[n].assign(log.t.size(), std::sqrt(thrust[n] / v.value("kT")) / v.value("km"));
  const auto still = [&](auto& sensor, std::array<double, 3> about, double noise) {
    Random random(9);
    for (std::size_t k = 0; k < 3; ++k)
      for (double& y : sensor[k]) y = about[k] + noise * random.normal();
  };
  still(log.w_B, {0, 0, 0}, 0.01), still(log.f_B, {0, 0, -v.g}, 0.1), still(log.v_W, {0, 0, 0}, 0.02);
  still(log.x_W, {0, 0, -5}, 0.005);
  log.q_WB[0].assign(log.t.size(), 1.0);
  Random random(4);
  for (std::size_t k = 1; k < 4; ++k)
    for (double& q : log.q_WB[k]) q = 1e-3 * random.normal();
  log.Omega.clear();
  return log;
}

}  // namespace ident::testing
