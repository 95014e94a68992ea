// What a flight holds besides the model: white noise of the sensors, and accelerations from outside.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "ident/flight/kernel/kernel.h"

namespace ident {

/// A first-order Gauss-Markov process: what light turbulence does to a vehicle (Dryden's longitudinal form),
/// white noise when tau is short.
struct ColouredNoise {
  double sigma = 0.0;  ///< standard deviation of a component
  double tau = 1.0;    ///< correlation time, s

  /// Share of the value that is left h seconds later.
  double carried(double h) const { return std::exp(-h / tau); }
};

/// Slow errors of what an estimator shows, by group and axis, in its unit; zero where there are none.
using SlowErrors = std::array<std::array<ColouredNoise, 3>, kShownGroups>;

/// What the air did in one log.
struct AirNoise {
  std::array<ColouredNoise, 3> w_dot;  ///< angular acceleration in the body frame, rad/s^2
  std::array<ColouredNoise, 3> v_dot;  ///< acceleration along the axes of NoiseModel::axes, m/s^2
};

/// White noise of every channel, slow errors of sensors that are estimators, and the process noise: the
/// sensors are the same in all logs, the air is not.
struct NoiseModel {
  std::array<double, kChannels> sigma{};
  std::vector<AirNoise> air;        ///< of each log
  SlowErrors slow{};                ///< of the sensors
  double q_motor = 0.0;             ///< spectral density on rotor speeds, (rad/s)^2/s
  GustAxes axes = GustAxes::world;  ///< of all v_dot

  AirNoise& in_log(int log) { return air[static_cast<std::size_t>(log)]; }
  const AirNoise& in_log(int log) const { return air[static_cast<std::size_t>(log)]; }
};

}  // namespace ident
