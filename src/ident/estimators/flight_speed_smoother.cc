// Kalman filter and Rauch-Tung-Striebel smoother of an integrated random walk.
#include "ident/estimators/flight_speed_smoother.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/estimators/flight_record_start.h"

namespace ident {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr std::size_t kLeast = 50;     // samples that tell noise from motion
constexpr std::size_t kEnough = 4000;  // of the first of these the levels are found
// Logarithm of the intensity in units of the noise's variance over the cube of the distance of samples: from
// a straight line to no smoothing at all. Beyond the second there is no noise.
constexpr double kSmooth = -16.0, kNoNoise = 9.0;
constexpr double kDiffuse = 1e7;
// Times the likely intensity: a motor does not walk at random. In simulated flights inertias are about as
// much too large with that as they are too small without it.
constexpr double kRougher = 10.0;

// Speed and its rate in units of the noise, from one row to the next.
struct Walk {
  double q;  // intensity

  Matrix2d transition(double h) const { return (Matrix2d() << 1, h, 0, 1).finished(); }
  Matrix2d noise(double h) const {
    return q * (Matrix2d() << h * h * h / 3, h * h / 2, h * h / 2, h).finished();
  }
};

struct State {
  Vector2d x;
  Matrix2d P;
};

// What was sampled, and where.
struct Samples {
  const std::vector<double>& t;
  std::vector<double> y;  // NaN where there is none
  double distance;        // of samples, s
};

State before(const Samples& samples) {
  const double first = *std::ranges::find_if(samples.y, [](double y) { return std::isfinite(y); });
  return {{first, 0.0},
          Vector2d(kDiffuse, kDiffuse / (samples.distance * samples.distance)).asDiagonal().toDenseMatrix()};
}

// Calls `seen` with each row's state before its sample and after it, for `rows` rows.
template <class Seen>
void filter(const Samples& samples, const Walk& walk, std::size_t rows, Seen seen) {
  State s = before(samples);
  for (std::size_t i = 0; i < rows; ++i) {
    if (i > 0) {
      const double h = samples.t[i] - samples.t[i - 1];
      const Matrix2d F = walk.transition(h);
      s = {F * s.x, F * s.P * F.transpose() + walk.noise(h)};
    }
    const State predicted = s;
    if (std::isfinite(samples.y[i])) {
      const double S = s.P(0, 0) + 1.0;
      const Vector2d gain = s.P.col(0) / S;
      s.x += gain * (samples.y[i] - s.x[0]);
      s.P -= gain * s.P.row(0);
    }
    seen(i, predicted, s);
  }
}

// Minus twice the log likelihood, the level of the noise at its best.
double surprise(const Samples& samples, const Walk& walk) {
  double square = 0, log_det = 0, n = -2;  // two samples say where it begins
  filter(samples, walk, std::min(samples.y.size(), kEnough),
         [&](std::size_t i, const State& predicted, const State&) {
           if (!std::isfinite(samples.y[i]) || ++n <= 0) return;
           const double S = predicted.P(0, 0) + 1.0, e = samples.y[i] - predicted.x[0];
           square += e * e / S, log_det += std::log(S);
         });
  return n > 0 && square > 0 ? n * std::log(square / n) + log_det : kNaN;
}

// The most likely intensity, as a logarithm in the units above; NaN where the samples leave no noise.
double likely(const Samples& samples) {
  const double cube = std::pow(samples.distance, 3);
  const auto at = [&](double log_q) { return surprise(samples, {std::exp(log_q) / cube}); };
  constexpr double kStep = 2.5, kGolden = 0.381966;
  double best = kSmooth, least = at(kSmooth);
  for (double x = kSmooth + kStep; x <= kNoNoise; x += kStep)
    if (const double y = at(x); y < least) best = x, least = y;
  double low = best - kStep, high = best + kStep;
  while (high - low > 0.2) {
    const double a = low + kGolden * (high - low), b = high - kGolden * (high - low);
    const bool left = at(a) < at(b);
    (left ? high : low) = left ? b : a;
  }
  const double found = 0.5 * (low + high);
  return std::isfinite(least) && found < kNoNoise - kStep / 2 ? found : kNaN;
}

std::vector<double> smoothed(const Samples& samples, const Walk& walk) {
  const std::size_t n = samples.y.size();
  std::vector<State> predicted(n), filtered(n);
  filter(samples, walk, n,
         [&](std::size_t i, const State& a, const State& b) { predicted[i] = a, filtered[i] = b; });
  std::vector<double> out(n);
  Vector2d x = filtered[n - 1].x;
  out[n - 1] = x[0];
  for (std::size_t i = n - 1; i-- > 0;) {
    const Matrix2d F = walk.transition(samples.t[i + 1] - samples.t[i]);
    x = filtered[i].x +
        filtered[i].P * F.transpose() * predicted[i + 1].P.inverse() * (x - predicted[i + 1].x);
    out[i] = x[0];
  }
  return out;
}

}  // namespace

SmoothedSpeed smoothed_speed(const std::vector<double>& t, const std::vector<double>& speed) {
  Samples samples{t, speed, 0.0};
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
  const double log_q = likely(samples);
  if (!std::isfinite(log_q)) return {as_it_is, as_it_is};
  const double q = std::exp(log_q) / std::pow(samples.distance, 3);
  return {smoothed(samples, {q}), smoothed(samples, {kRougher * q})};
}

}  // namespace ident
