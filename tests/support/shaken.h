// Flights whose inertial sensors feel the rotors turn.
#pragma once

#include <cmath>
#include <vector>

#include "ident/model/vehicle.h"
#include "ident/sim/simulate.h"

namespace ident::testing {

/// A quadrotor whose rotors turn some 75 times a second.
inline Vehicle shaken_vehicle() {
  Vehicle v;
  v.name = "shaken", v.layout = "x", v.arm = 0.17, v.rotors = layout_rotors("x", 0.17, 0.0);
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{{"m", 0.6},
                                                                                         {"kT", 6.4e-6},
                                                                                         {"kQ", 1.0e-7},
                                                                                         {"km", 900},
                                                                                         {"omega_m", 28},
                                                                                         {"zeta_m", 0.9},
                                                                                         {"dead_time", 0.004},
                                                                                         {"Jxx", 3e-3},
                                                                                         {"Jyy", 3.2e-3},
                                                                                         {"Jzz", 5.6e-3},
                                                                                         {"Jp", 5e-6}})
    v.parameters[name] = {value, {}};
  for (const char* name : {"kT", "kQ", "km", "omega_m", "Jxx", "Jyy", "Jzz", "Jp"})
    v.parameters[name].std = 0.05 * v.parameters[name].value;
  return v;
}

inline FlightLog flown(const Vehicle& vehicle, std::uint64_t seed, bool speeds, double rate = 250.0) {
  SimulationOptions options;
  options.duration = 30.0, options.rate = rate, options.seed = seed;
  FlightLog log = simulate_flight(vehicle, options).log;
  if (!speeds) log.Omega.clear();
  return log;
}

/// Adds a tone of each rotor to specific force (amplitude in m/s^2 at the speed `usual`, growing with the
/// square of the speed) and to the rates (`of_rates` times that, rad/s), and one at twice its turns along z.
/// `Omega`: [rotor][row].
inline void shake(FlightLog& log, const std::vector<std::vector<double>>& Omega, double usual,
                  const std::vector<double>& amplitude, double of_rates) {
  for (std::size_t n = 0; n < amplitude.size(); ++n) {
    double angle = 1.0 + static_cast<double>(n);
    for (std::size_t i = 0; i < log.rows(); ++i) {
      if (i > 0) angle += 0.5 * (Omega[n][i] + Omega[n][i - 1]) * (log.t[i] - log.t[i - 1]);
      const double size = amplitude[n] * std::pow(Omega[n][i] / usual, 2), turn = of_rates * size;
      log.f_B[0][i] += size * std::cos(angle), log.f_B[1][i] += size * std::sin(angle);
      log.f_B[2][i] += 0.4 * size * std::cos(2 * angle);
      log.w_B[0][i] += turn * std::sin(angle), log.w_B[1][i] += turn * std::cos(angle);
      log.w_B[2][i] += 0.4 * turn * std::cos(angle + 0.5);
    }
  }
}

/// That of a log which has rotor speeds, with amplitudes at 450 rad/s.
inline FlightLog shaken(FlightLog log, const std::vector<double>& amplitude) {
  shake(log, log.Omega, 450.0, amplitude, 0.05);
  return log;
}

}  // namespace ident::testing
