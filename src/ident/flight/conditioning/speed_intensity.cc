// Likelihood of constant intensities first, block by block, which tells the noise; then a chain of
// intensities in time: one filter runs for each of a range of them as if it had held from the start, and what
// they make of each sample is weighed forward and backward.
#include "ident/flight/conditioning/speed_intensity.h"

#include "ident/result/result.h"

namespace ident {
namespace {

constexpr std::size_t kBlock = 4000;  // samples of which the noise is taken to be even
// Logarithm of the intensity in units of the noise's variance over the cube of the distance of samples: from
// a straight line to no smoothing at all. Beyond the second there is no noise.
constexpr double kSmooth = -16.0, kNoNoise = 9.0;
constexpr int kLevels = 26;  // of the chain, one apart
// Chances that the level becomes a neighbouring one, and any one, from one sample to the next. With more,
// noise passes for motion: what is left of it then grows with what is found of the rate.
constexpr float kMove = 0.003F, kJump = 1e-15F;
// Least likelihood of a sample against that of its best level: it takes three in a row to be a burst, so that
// one or two false ones are none.
constexpr float kLeast = 1e-6F;
// The intensity is a power mean over the levels: that of the logarithm would leave out what is driven with a
// chance of one in two, the plain one follows what hardly may be.
constexpr double kPower = 0.25;
constexpr float kNever = 1e-20F;  // keeps a level in reach

struct SpeedLevel {
  double log_q;     // NaN where the samples leave no noise
  double variance;  // of the noise, (rad/s)^2
};

// Minus twice the log likelihood of an intensity, the level of the noise at its best.
double surprise(const SpeedSamples& samples, double q, double* variance) {
  double square = 0, log_det = 0, n = -2;  // two samples say where it begins
  filter_speed(
      samples, [q](std::size_t) { return q; }, samples.y.size(),
      [&](std::size_t i, const SpeedState& predicted, const SpeedState&) {
        if (!std::isfinite(samples.y[i]) || ++n <= 0) return;
        const double S = predicted.P(0, 0) + 1.0, e = samples.y[i] - predicted.x[0];
        square += e * e / S, log_det += std::log(S);
      });
  *variance = square / n;
  return n > 0 && square > 0 ? n * std::log(square / n) + log_det : kNaN;
}

// The most likely constant one.
SpeedLevel constant_level(const SpeedSamples& samples, double cube) {
  double variance = kNaN;
  const auto at = [&](double log_q) { return surprise(samples, std::exp(log_q) / cube, &variance); };
  constexpr double kStepIntensity = 2.5, kGolden = 0.381966;
  double best = kSmooth, least = at(kSmooth);
  for (double x = kSmooth + kStepIntensity; x <= kNoNoise; x += kStepIntensity)
    if (const double y = at(x); y < least) best = x, least = y;
  double low = best - kStepIntensity, high = best + kStepIntensity;
  while (high - low > 0.2) {
    const double a = low + kGolden * (high - low), b = high - kGolden * (high - low);
    const bool left = at(a) < at(b);
    (left ? high : low) = left ? b : a;
  }
  const double found = 0.5 * (low + high);
  if (!std::isfinite(least) || found >= kNoNoise - kStepIntensity / 2) return {kNaN, kNaN};
  at(found);
  return {found, variance};
}

// Variance of the noise in each row, from blocks of samples; NaN in those that leave none.
std::vector<double> noise_of(const SpeedSamples& samples, double cube) {
  const std::size_t n = samples.y.size();
  std::size_t left = 0;
  for (const double y : samples.y) left += std::isfinite(y) ? 1 : 0;
  std::vector<double> out;
  while (out.size() < n) {
    const std::size_t wanted = left < 2 * kBlock ? left : kBlock;  // the last one takes the rest
    std::vector<double> t, y;
    std::size_t taken = 0;
    for (std::size_t i = out.size(); i < n && (taken < wanted || wanted == left); ++i) {
      t.push_back(samples.t[i]), y.push_back(samples.y[i]);
      taken += std::isfinite(samples.y[i]) ? 1 : 0;
    }
    left -= taken;
    const double variance = constant_level({t, y, samples.distance}, cube).variance;
    out.insert(out.end(), t.size(), variance);
  }
  return out;
}

using Weights = Eigen::Array<float, kLevels, 1>;

double log_intensity(int level) { return kSmooth + level; }

// What each level's own filter makes of the samples: likelihoods of every row, the best of them one.
std::vector<Weights> likelihoods(const SpeedSamples& samples, const std::vector<double>& noise, double cube) {
  std::vector<Weights> out(samples.y.size(), Weights::Zero());
  for (int level = 0; level < kLevels; ++level) {
    const double q = std::exp(log_intensity(level)) / cube;
    filter_speed(
        samples, [q](std::size_t) { return q; }, samples.y.size(),
        [&](std::size_t i, const SpeedState& predicted, const SpeedState&) {
          if (!std::isfinite(samples.y[i]) || !std::isfinite(noise[i])) return;
          const double S = predicted.P(0, 0) + 1.0, e = samples.y[i] - predicted.x[0];
          out[i][level] = static_cast<float>(-0.5 * (e * e / (S * noise[i]) + std::log(S)));
        });
  }
  for (Weights& w : out) w = (w - w.maxCoeff()).exp().max(kLeast);
  return out;
}

// One step of the chain: a level stays, becomes the next lower or higher one, or any.
Weights moved(const Weights& p) {
  Weights out = (1.0F - kMove - kJump) * p + kJump * p.mean();
  out.head<kLevels - 1>() += kMove / 2 * p.tail<kLevels - 1>();
  out.tail<kLevels - 1>() += kMove / 2 * p.head<kLevels - 1>();
  out[0] += kMove / 2 * p[0], out[kLevels - 1] += kMove / 2 * p[kLevels - 1];
  return out;
}

Weights normal(const Weights& p) { return (p / p.sum()).max(kNever); }

}  // namespace

SpeedIntensities likely_intensities(const SpeedSamples& samples) {
  const double cube = std::pow(samples.distance, 3);
  std::vector<double> noise = noise_of(samples, cube);
  if (std::ranges::none_of(noise, [](double v) { return std::isfinite(v); })) return {};
  const std::vector<Weights> seen = likelihoods(samples, noise, cube);
  const std::size_t n = seen.size();
  const auto sampled = [&](std::size_t i) { return std::isfinite(samples.y[i]); };

  std::vector<Weights> past(n);
  Weights p = Weights::Constant(1.0F / kLevels);
  for (std::size_t i = 0; i < n; ++i) {
    if (sampled(i)) p = normal(moved(p) * seen[i]);
    past[i] = p;
  }
  Weights levels;
  for (int level = 0; level < kLevels; ++level)
    levels[level] = static_cast<float>(std::exp(kPower * log_intensity(level)));
  SpeedIntensities out{std::vector<double>(n), std::move(noise)};
  Weights future = Weights::Constant(1.0F / kLevels);
  for (std::size_t i = n; i-- > 0;) {
    const Weights both = past[i] * future;
    out.q[i] = (std::isfinite(out.noise[i])
                    ? std::pow(static_cast<double>((both * levels).sum() / both.sum()), 1 / kPower)
                    : std::exp(kNoNoise + 2)) /
               cube;
    if (sampled(i)) future = normal(moved(future * seen[i]));
  }
  return out;
}

}  // namespace ident
