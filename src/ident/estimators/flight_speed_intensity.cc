// Likelihood of constant intensities first, which tells the noise; then a chain of intensities in time: one
// filter runs for each of a range of them, and what they make of each sample is weighed forward and backward.
#include "ident/estimators/flight_speed_intensity.h"

#include "ident/core/result.h"

namespace ident {
namespace {

constexpr std::size_t kEnough = 4000;  // of the first of these samples the noise is found
// Logarithm of the intensity in units of the noise's variance over the cube of the distance of samples: from
// a straight line to no smoothing at all. Beyond the second there is no noise.
constexpr double kSmooth = -16.0, kNoNoise = 9.0;
constexpr int kLevels = 26;     // of the chain, one apart
constexpr double kMove = 0.003;  // chance that the level changes from one sample to the next

struct Level {
  double log_q;     // NaN where the samples leave no noise
  double variance;  // of the noise, in units of the samples'
};

// Minus twice the log likelihood of an intensity, the level of the noise at its best.
double surprise(const SpeedSamples& samples, double q, double* variance) {
  double square = 0, log_det = 0, n = -2;  // two samples say where it begins
  filter_speed(
      samples, [q](std::size_t) { return q; }, std::min(samples.y.size(), kEnough),
      [&](std::size_t i, const SpeedState& predicted, const SpeedState&) {
        if (!std::isfinite(samples.y[i]) || ++n <= 0) return;
        const double S = predicted.P(0, 0) + 1.0, e = samples.y[i] - predicted.x[0];
        square += e * e / S, log_det += std::log(S);
      });
  *variance = square / n;
  return n > 0 && square > 0 ? n * std::log(square / n) + log_det : kNaN;
}

// The most likely constant one.
Level constant_level(const SpeedSamples& samples, double cube) {
  double variance = kNaN;
  const auto at = [&](double log_q) { return surprise(samples, std::exp(log_q) / cube, &variance); };
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
  if (!std::isfinite(least) || found >= kNoNoise - kStep / 2) return {kNaN, kNaN};
  at(found);
  return {found, variance};
}

using Weights = Eigen::Array<float, kLevels, 1>;

double log_intensity(int level) { return kSmooth + level; }

// What each level's own filter makes of the samples: likelihoods of every row, the best of them one.
std::vector<Weights> likelihoods(const SpeedSamples& samples, double variance, double cube) {
  std::vector<Weights> out(samples.y.size(), Weights::Zero());
  for (int level = 0; level < kLevels; ++level) {
    const double q = std::exp(log_intensity(level)) / cube;
    filter_speed(
        samples, [q](std::size_t) { return q; }, samples.y.size(),
        [&](std::size_t i, const SpeedState& predicted, const SpeedState&) {
          if (!std::isfinite(samples.y[i])) return;
          const double S = predicted.P(0, 0) + 1.0, e = samples.y[i] - predicted.x[0];
          out[i][level] = static_cast<float>(-0.5 * (e * e / (S * variance) + std::log(S)));
        });
  }
  for (Weights& w : out) w = (w - w.maxCoeff()).exp();
  return out;
}

// One step of the chain: a level stays or becomes the next lower or higher one.
Weights moved(const Weights& p) {
  Weights out = (1.0F - static_cast<float>(kMove)) * p;
  const float part = static_cast<float>(kMove) / 2;
  out.head<kLevels - 1>() += part * p.tail<kLevels - 1>();
  out.tail<kLevels - 1>() += part * p.head<kLevels - 1>();
  out[0] += part * p[0], out[kLevels - 1] += part * p[kLevels - 1];
  return out;
}

}  // namespace

std::vector<double> likely_intensities(const SpeedSamples& samples) {
  const double cube = std::pow(samples.distance, 3);
  const Level constant = constant_level(samples, cube);
  if (!std::isfinite(constant.log_q)) return {};
  const std::vector<Weights> seen = likelihoods(samples, constant.variance, cube);
  const std::size_t n = seen.size();
  const auto sampled = [&](std::size_t i) { return std::isfinite(samples.y[i]); };

  std::vector<Weights> past(n);
  Weights p = Weights::Constant(1.0F / kLevels);
  for (std::size_t i = 0; i < n; ++i) {
    if (sampled(i)) p = moved(p) * seen[i];
    past[i] = p /= p.sum();
  }
  Weights levels;
  for (int level = 0; level < kLevels; ++level) levels[level] = static_cast<float>(log_intensity(level));
  std::vector<double> out(n);
  Weights future = Weights::Ones();
  for (std::size_t i = n; i-- > 0;) {
    const Weights both = past[i] * future;
    out[i] = std::exp(static_cast<double>((both * levels).sum() / both.sum())) / cube;
    if (sampled(i)) future = moved(future * seen[i]);
    future /= future.sum();
  }
  return out;
}

}  // namespace ident
