// The noise of a flight: white noise of the sensors, slow errors, accelerations from outside, noise of the
// motors.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "ident/flight/kernel/kernel.h"

namespace ident {

/// A first-order Gauss-Markov process: what light turbulence does to a vehicle (longitudinal form of Dryden).
/// It is white noise when tau is short.
struct ColouredNoise {
  double sigma = 0.0;  ///< standard deviation of a component
  double tau = 1.0;    ///< correlation time, s

  /// Share of the value that remains h seconds later.
  double carried(double h) const { return std::exp(-h / tau); }
};

/// Slow errors of an estimator, by group (attitude, velocity, position) and axis, in the unit of the group;
/// zero where there are none.
using SlowErrors = std::array<std::array<ColouredNoise, 3>, kShownGroups>;

/// Gusts of one log.
struct AirNoise {
  std::array<ColouredNoise, 3> w_dot;  ///< angular acceleration in the body frame, rad/s^2
  std::array<ColouredNoise, 3> v_dot;  ///< acceleration along the axes of NoiseModel::axes, m/s^2
};

/// White noise of every channel, slow errors of estimated signals, and the process noise. The sensors are the
/// same in all logs, the air is not.
struct NoiseModel {
  std::array<double, kChannels> sigma{};
  std::vector<AirNoise> air;        ///< by log
  SlowErrors slow{};                ///< of estimated attitude, velocity, position
  double q_motor = 0.0;             ///< spectral density on rotor speeds, (rad/s)^2/s
  GustAxes axes = GustAxes::world;  ///< of all v_dot

  AirNoise& in_log(int log) { return air[static_cast<std::size_t>(log)]; }
  const AirNoise& in_log(int log) const { return air[static_cast<std::size_t>(log)]; }
};

}  // namespace ident
