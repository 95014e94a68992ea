// Integrated random walk of a rotor's speed and its Kalman filter.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ident {

/// What was sampled of a rotor's speed, and where.
struct SpeedSamples {
  const std::vector<double>& t;
  std::vector<double> y;  ///< NaN in rows without a sample
  double distance = 0;    ///< of samples, s
};

/// Speed and its rate, rad/s and rad/s^2, and their covariance in units of the noise's variance.
struct SpeedState {
  Eigen::Vector2d x;
  Eigen::Matrix2d P;
};

inline Eigen::Matrix2d walk_transition(double h) { return (Eigen::Matrix2d() << 1, h, 0, 1).finished(); }

/// One step of h seconds in which the rate walks with intensity q.
inline SpeedState walked(const SpeedState& s, double h, double q) {
  const Eigen::Matrix2d F = walk_transition(h),
                        Q = q * (Eigen::Matrix2d() << h * h * h / 3, h * h / 2, h * h / 2, h).finished();
  return {F * s.x, F * s.P * F.transpose() + Q};
}

/// What a sample y makes of a state; NaN: nothing.
inline SpeedState updated(const SpeedState& s, double y) {
  if (!std::isfinite(y)) return s;
  const Eigen::Vector2d gain = s.P.col(0) / (s.P(0, 0) + 1.0);
  return {s.x + gain * (y - s.x[0]), s.P - gain * s.P.row(0)};
}

/// Before the first row, of which next to nothing is known.
inline SpeedState before_flight(const SpeedSamples& samples) {
  constexpr double kDiffuse = 1e7;
  const double first = *std::ranges::find_if(samples.y, [](double y) { return std::isfinite(y); });
  return {{first, 0.0},
          Eigen::Vector2d(kDiffuse, kDiffuse / (samples.distance * samples.distance))
              .asDiagonal()
              .toDenseMatrix()};
}

/// Calls seen(i, before its sample, after it) with the states of `rows` rows; q(i) is the intensity from row
/// i - 1 to row i.
template <class Intensity, class Seen>
void filter_speed(const SpeedSamples& samples, const Intensity& q, std::size_t rows, Seen seen) {
  SpeedState s = before_flight(samples);
  for (std::size_t i = 0; i < rows; ++i) {
    if (i > 0) s = walked(s, samples.t[i] - samples.t[i - 1], q(i));
    const SpeedState predicted = s;
    s = updated(s, samples.y[i]);
    seen(i, predicted, s);
  }
}

}  // namespace ident
