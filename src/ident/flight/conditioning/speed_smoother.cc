// Kalman filter and Rauch-Tung-Striebel smoother of an integrated random walk.
#include "ident/flight/conditioning/speed_smoother.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ident/flight/conditioning/speed_intensity.h"
#include "ident/flight/record/initial_states.h"
#include "ident/result/result.h"

namespace ident {
namespace {

constexpr std::size_t kLeastSpeeds = 50;  // samples that tell noise from motion
// Times the likely intensities: a motor does not walk at random.
constexpr double kRougher = 3.0;
constexpr std::size_t kMostFalse = 2;
constexpr double kAgree = 3.0;  // times what its neighbours differ, a false sample is off
constexpr double kFalse = 8.0;  // standard deviations of the noise
constexpr double kHole = 10.0;  // s, longer than any piece of flight over which means are taken

// Speeds, and what stays unknown of them in units of the noise's variance.
struct Smoothed {
  std::vector<double> speed, variance;
};

Smoothed smoothed(const SpeedSamples& samples, const std::vector<double>& q, double times) {
  const std::size_t n = samples.y.size();
  std::vector<SpeedState> predicted(n), filtered(n);
  filter_speed(
      samples, [&](std::size_t i) { return times * q[i]; }, n,
      [&](std::size_t i, const SpeedState& a, const SpeedState& b) { predicted[i] = a, filtered[i] = b; });
  Smoothed out{std::vector<double>(n), std::vector<double>(n)};
  SpeedState s = filtered[n - 1];
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) {
      const Eigen::Matrix2d F = walk_transition(samples.t[i + 1] - samples.t[i]);
      const Eigen::Matrix2d gain = filtered[i].P * F.transpose() * predicted[i + 1].P.inverse();
      s.x = filtered[i].x + gain * (s.x - predicted[i + 1].x);
      s.P = filtered[i].P + gain * (s.P - predicted[i + 1].P) * gain.transpose();
    }
    out.speed[i] = s.x[0], out.variance[i] = s.P(0, 0);
  }
  return out;
}

// Takes out samples that lie far off what all others say, one or two in a row between some that agree: else
// it is a motor that stops. Whether there are any.
bool drop_false(SpeedSamples& samples, const std::vector<double>& likely, const std::vector<double>& noise) {
  std::vector<std::size_t> run, rows;
  double before = kNaN;
  const auto end_run = [&](double after) {
    const auto off = [&](std::size_t i) {
      return std::abs(samples.y[i] - after) > kAgree * std::abs(before - after);
    };
    if (run.size() <= kMostFalse && std::ranges::all_of(run, off))
      rows.insert(rows.end(), run.begin(), run.end());
    run.clear(), before = after;
  };
  for (std::size_t i = 0; i < likely.size(); ++i) {
    if (!std::isfinite(samples.y[i])) continue;
    if (std::abs(samples.y[i] - likely[i]) > kFalse * std::sqrt(noise[i]))
      run.push_back(i);
    else
      end_run(samples.y[i]);
  }
  for (const std::size_t i : rows) samples.y[i] = kNaN;
  return !rows.empty();
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
  if (count < kLeastSpeeds) return {as_it_is, as_it_is, {}, {}};
  samples.distance = (end - first) / static_cast<double>(count - 1);
  SpeedIntensities found = likely_intensities(samples);
  if (found.q.empty()) return {as_it_is, as_it_is, {}, {}};
  Smoothed likely = smoothed(samples, found.q, 1.0);
  if (drop_false(samples, likely.speed, found.noise)) {
    found = likely_intensities(samples);
    if (found.q.empty()) return {as_it_is, as_it_is, {}, {}};
    likely = smoothed(samples, found.q, 1.0);
  }
  SmoothedSpeed out{std::move(likely.speed), smoothed(samples, found.q, kRougher).speed, {}, {}};
  for (std::size_t i = 0; i < found.noise.size(); ++i) {
    const double noise = std::isfinite(found.noise[i]) ? found.noise[i] : 0.0;
    // Worse known than a sample: a hole, in which the error is the same for long.
    const double lasts = likely.variance[i] > 1 ? kHole * likely.variance[i] : samples.distance;
    out.variance.push_back(noise * likely.variance[i]), out.density.push_back(noise * lasts);
  }
  return out;
}

}  // namespace ident
