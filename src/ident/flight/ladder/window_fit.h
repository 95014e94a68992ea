// Least squares of a model's constants over windows of measured flight: the velocity that its forces give, or
// the rates that its moments give, attitude and rates being those measured.
//
// Over a window from t1 to t2, with R f the specific force in the world and w' the angular acceleration,
//
//   v(t2) - v(t1) - g (t2 - t1) = int R f dt        w(t2) - w(t1) = int w' dt                            (1)
//
// so that no signal is differentiated: a window of T seconds passes what is slower than about 1/(2 T), which
// filters of a log's makers leave alone.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/flight/ladder/window_residuals.h"
#include "ident/flight/smoother/parameterisation.h"

namespace ident {

struct WindowFit {
  std::vector<double> p;       ///< the model's constants, those that were fitted among them
  Eigen::VectorXd u;           ///< of the theta of the call
  Eigen::MatrixXd covariance;  ///< of u: residuals are taken for as coloured as blocks of them show
  std::vector<bool> at_limit;  ///< [constant] the fit asked for more than a vehicle can have
  std::size_t windows = 0;
};

/// A constant of the model that is not fitted, and the standard deviation with which it is known.
struct HeldConstant {
  int index = 0;
  double std = 0.0;
};

/// Constants of `theta` (no gyro bias) from (1) and their priors. The error of the model is taken to grow
/// with speed as the residuals show it to, so that slow flight, in which thrust carries the weight and little
/// else acts, says what thrust is. Estimates do not leave what a vehicle can have; see `limits_of`.
/// The covariance has its part from `held`: what the estimates move by where one of them is a deviation off.
/// The search begins at the constants `from`.
WindowFit fit_windows(const MeasuredMotion& motion, const Theta& theta, FitTo what,
                      const std::vector<HeldConstant>& held, const std::vector<double>& from);

}  // namespace ident
