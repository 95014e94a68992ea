// Flights in which a command of 0 switches the motors off: they coast there by their propellers' drag.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/known_quad.h"

namespace ident::testing {

/// Rates, specific force and attitude of quad() with first-order motors behind its dead time, 500 Hz, held
/// level by its rates alone; every two to four seconds all motors are off for 0.15 to 0.4 s, and run down at
/// `coasts` times their speed over that in hover, 1/s; 0: as they follow any other command. Body, motors and
/// steps are not those of the library.
inline FlightLog coasting_flight(const Vehicle& v, double lag, double coasts, std::uint64_t seed,
                                 double seconds = 30.0) {
  constexpr double kStep = 5e-4, kGyro = 0.02, kForce = 0.15, kTurn = 0.002;
  constexpr int kRow = 4;  // steps
  Random random(seed);
  const double m = v.value("m"), kT = v.value("kT"), kQ = v.value("kQ"), km = v.value("km");
  const double l = v.rotors[0].r_B[0], hover = std::sqrt(m * v.g / 4 / kT);
  const std::array J{v.value("Jxx"), v.value("Jyy"), v.value("Jzz")};
  FlightLog log;
  log.file = "coasting";
  log.delta.resize(4);
  std::array<double, 4> Omega{hover, hover, hover, hover}, delta{};
  const auto late = static_cast<std::size_t>(std::lround(v.value("dead_time") / kStep));
  std::vector<std::array<double, 4>> given;  // by step
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  std::array<double, 3> w{}, wanted{};
  double lift = 1, change = 0, off = random.uniform(2, 4), on = off;
  for (int i = 0; i * kStep < seconds; ++i) {
    const double t = i * kStep;
    if (t >= change) {
      for (double& x : wanted) x = random.uniform(-3, 3);
      lift = random.uniform(0.7, 1.4), change = t + random.uniform(0.1, 0.3);
    }
    if (t >= off) on = t + random.uniform(0.15, 0.4), off = on + random.uniform(2, 4);
    double thrust = 0;
    std::array<double, 3> moment{};
    for (std::size_t n = 0; n < 4; ++n) thrust += kT * Omega[n] * Omega[n];
    moment[0] = l * kT * (Omega[1] * Omega[1] - Omega[3] * Omega[3]);
    moment[1] = l * kT * (Omega[0] * Omega[0] - Omega[2] * Omega[2]);
    for (std::size_t n = 0; n < 4; ++n) moment[2] += v.rotors[n].s * kQ * Omega[n] * Omega[n];
    if (i % kRow == 0) {
      std::array<double, 3> felt{};
      for (std::size_t k = 0; k < 3; ++k) felt[k] = w[k] + kGyro * random.normal();
      const auto give = [&](std::size_t k) { return J[k] * 12 * (wanted[k] - felt[k]); };
      for (std::size_t n = 0; n < 4; ++n) {
        const double arm = n % 2 == 0 ? (n == 0 ? 1 : -1) * give(1) : (n == 1 ? 1 : -1) * give(0);
        const double share = lift * m * v.g / 4 + arm / (2 * l) + v.rotors[n].s * give(2) * kT / kQ / 4;
        delta[n] = t < on ? 0.0 : std::clamp(std::sqrt(std::max(share, 0.0) / kT) / km, 0.1, 1.0);
        log.delta[n].push_back(delta[n]);
      }
      log.t.push_back(t);
      const std::array shown{q.w(), q.x(), q.y(), q.z()};
      for (std::size_t k = 0; k < 4; ++k) log.q_WB[k].push_back(shown[k] + kTurn / 2 * random.normal());
      for (std::size_t k = 0; k < 3; ++k) {
        log.w_B[k].push_back(felt[k]);
        log.f_B[k].push_back(kForce * random.normal() - (k == 2 ? thrust / m : 0.0));
      }
    }
    const std::array about{(J[2] - J[1]) * w[1] * w[2], (J[0] - J[2]) * w[2] * w[0],
                           (J[1] - J[0]) * w[0] * w[1]};
    for (std::size_t k = 0; k < 3; ++k) w[k] += kStep * (moment[k] - about[k]) / J[k];
    q *= Eigen::Quaterniond(1, kStep / 2 * w[0], kStep / 2 * w[1], kStep / 2 * w[2]), q.normalize();
    given.push_back(delta);
    const std::array<double, 4>& told = given[given.size() - 1 - std::min(late, given.size() - 1)];
    for (std::size_t n = 0; n < 4; ++n)
      Omega[n] += kStep * (told[n] > 0 || coasts == 0 ? (km * told[n] - Omega[n]) / lag
                                                      : -coasts * Omega[n] * Omega[n] / hover);
  }
  return log;
}

}  // namespace ident::testing
