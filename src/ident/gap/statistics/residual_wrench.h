// What the model does not explain, as force and moment on the body and as rotor acceleration, over time.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ident/flight/fit/fit.h"

namespace ident {

/// One row for each chunk of the smoother: the residual of every channel, its noise, and where the vehicle
/// was.
struct ResidualWrench {
  std::vector<std::string> names;  ///< Fx Fy Fz Mx My Mz rotor1..N, those that the signals allow
  std::vector<double> t;
  std::vector<int> log;
  Eigen::MatrixXd residual;  ///< [chunk][channel], N, N m, rad/s^2
  Eigen::VectorXd noise;     ///< standard deviation of a row of each channel for a perfect model
  /// Regime variables by name: airspeed, climb, tilt, rates, collective, height, voltage.
  std::vector<std::pair<std::string, Eigen::VectorXd>> regimes;

  /// rms of each channel, and max(0, rms^2/noise^2 - 1).
  Eigen::VectorXd rms() const;
  Eigen::VectorXd excess() const;
};

ResidualWrench residual_wrench(const FlightRecord& record, const Theta& theta, const FlightFit& fit,
                               const NoiseModel& floor);

}  // namespace ident
