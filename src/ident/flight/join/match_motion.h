// Where a recording of the same flight by another device lies on the clock of a log, and how its body's axes
// are turned.
//
// Both devices see the rates of the vehicle: the log by its gyro or attitude, w(t), the recording by its
// attitude, u(t). With the turn C between the axes of the two bodies and clocks that run evenly,
//
//   w(t + offset + drift (t - middle)) = C u(t) + noise
//
// |w| and |u| do not know C: their correlation over all offsets gives the candidates (numbers of a Fourier
// transform). Gauss-Newton steps in offset and drift, with C by singular values in each, refine every one
// of them [Wahba, A least squares estimate of satellite attitude, SIAM Review 7, 1965; Kabsch, 1976].
#pragma once

#include <Eigen/Core>
#include <numbers>

#include "ident/data/flight_log.h"

namespace ident {

struct MotionMatch {
  double offset = 0.0;  ///< s: time of the log less time of the recording, at `middle`
  double std = 0.0;     ///< s, of the offset
  double middle = 0.0;  ///< s, time of the recording
  double drift = 0.0;   ///< s a second by which the log's clock is ahead more
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< from the recorded body's axes to the log's
  double turn_std = std::numbers::pi;                  ///< rad, about the axis about which it is known worst
  double alike = 0.0;                                  ///< share of the rates that the recording explains
  double seconds = 0.0;                                ///< that both show

  double to_log(double t) const { return t + offset + drift * (t - middle); }
};

/// Throws DataError where one of them does not show how it turned, where nothing agrees, and where several
/// offsets do.
MotionMatch match_motion(const FlightLog& log, const FlightLog& recording);

}  // namespace ident
