// Thrust and torque constant of one sweep, with its tares and, where rows are repeated, the noise of the
// speed.
//
//   thrust_i = thrust_tare + kT x_i^2 ,   torque_i = torque_tare + kQ x_i^2     in motion    (1)
//   thrust_i = thrust_tare ,              torque_i = torque_tare                at rest
//
// Without repeated rows x_i is the measured speed w_i. With them the true speed Omega_j of each set-point j
// is an unknown of its own, and of a reading's deviation from it a share is real and drives the forces:
//
//   w_i = Omega_j + noise ,   x_i = Omega_j + speed_share (w_i - Omega_j)                    (2)
//
// speed_share is estimated: 0 where the speed sensor is noisy (the plain fit would then find kT too small), 1
// where the rotor's speed itself wanders. To judge the law, an offset in motion and a linear term are added
// to (1):
//
//   thrust_i = thrust_tare + offset + slope x_i + kT x_i^2                                   (3)
#pragma once

#include <vector>

#include "ident/bench/thrust/thrust_sweep_points.h"
#include "ident/lsq/least_squares.h"

namespace ident {

/// Whether the linear term of (3) is free.
enum class ThrustLaw { quadratic, with_linear_term };

/// Residuals (measured minus fitted) of the moving points of a channel, in their order.
struct ChannelResiduals {
  std::vector<double> Omega, fitted, residual, standardized;
  std::vector<bool> rejected;
  double rms = 0.0;    ///< of set-points, outliers left out
  double noise = 0.0;  ///< standard deviation of one point
  double rho = 0.0;    ///< autocorrelation at lag one
};

struct SweepFit {
  LeastSquaresFit fit;
  ChannelResiduals thrust, torque;
  bool speed_modelled = false;     ///< (2) was used
  double speed_noise = kNaN;       ///< rad/s, scatter of readings at a set-point
  double speed_share = kNaN;       ///< share of it that is real
  std::size_t speed_outliers = 0;  ///< readings of the speed that were left out
};

SweepFit fit_sweep(const SweepPoints& points, ThrustLaw law = ThrustLaw::quadratic);

/// Relative error of kT from (1) with the measured speed when that has a standard deviation of `sigma` rad/s.
double speed_noise_bias(const SweepChannel& channel, double sigma);

}  // namespace ident
