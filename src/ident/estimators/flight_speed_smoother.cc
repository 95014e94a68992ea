// Kalman filter and Rauch-Tung-Striebel smoother of an integrated random walk.
#include "ident/estimators/flight_speed_smoother.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ident/core/result.h"
#include "ident/estimators/flight_record_start.h"
#include "ident/estimators/flight_speed_intensity.h"

namespace ident {
namespace {

constexpr std::size_t kLeast = 50;  // samples that tell noise from motion
// Times the likely intensities: a motor does not walk at random.
constexpr double kRougher = 3.0;

std::vector<double> smoothed(const SpeedSamples& samples, const std::vector<double>& q, double times) {
  const std::size_t n = samples.y.size();
  std::vector<SpeedState> predicted(n), filtered(n);
  filter_speed(
      samples, [&](std::size_t i) { return times * q[i]; }, n,
      [&](std::size_t i, const SpeedState& a, const SpeedState& b) { predicted[i] = a, filtered[i] = b; });
  std::vector<double> out(n);
  Eigen::Vector2d x = filtered[n - 1].x;
  out[n - 1] = x[0];
  for (std::size_t i = n - 1; i-- > 0;) {
    const Eigen::Matrix2d F = walk_transition(samples.t[i + 1] - samples.t[i]);
    x = filtered[i].x +
        filtered[i].P * F.transpose() * predicted[i + 1].P.inverse() * (x - predicted[i + 1].x);
    out[i] = x[0];
  }
  return out;
}

}  // namespace

SmoothedSpeed smoothed_speed(const std::vector<double>& t, const std::vector<double>& speed) {
  SpeedSamples samples{t, speed};
  std::size_t count = 0;
  double last = kNaN, first = kNaN, end = kNaN;
  for (std::size_t i = 0; i < speed.size(); ++i) {
    if (!std::isfinite(speed[i])) continue;
    if (speed[i] == last) samples.y[i] = kNaN;  // held
    last = speed[i];
    if (!std::isfinite(samples.y[i])) continue;
    if (count++ == 0) first = t[i];
    end = t[i];
  }
  const std::vector<double> as_it_is = interpolated(t, speed);
  if (count < kLeast) return {as_it_is, as_it_is};
  samples.distance = (end - first) / static_cast<double>(count - 1);
  const std::vector<double> q = likely_intensities(samples);
  if (q.empty()) return {as_it_is, as_it_is};
  return {smoothed(samples, q, 1.0), smoothed(samples, q, kRougher)};
}

}  // namespace ident
