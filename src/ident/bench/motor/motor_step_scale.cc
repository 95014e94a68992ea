// Medians of settled and of moving rows.
#include "ident/bench/motor/motor_step_scale.h"

#include <algorithm>
#include <cmath>

#include "ident/bench/motor/motor_step_plateaus.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kMedianOfNormal = 0.674489750196082;  // of |x|
constexpr double kSettled = 3.0;                       // noise levels within which a row has settled
constexpr std::size_t kFewestRowsScale = 10;                // of either kind
constexpr double kMadSpread = 1.17;  // relative standard deviation of a MAD scale times sqrt(n), normal noise
constexpr double kResolution = 1e-6;  // of the largest way: no speed is known better
constexpr double kEvidentScale = 4.0;      // standard deviations

double median_size(std::span<const double> residuals, std::span<const double> ways,
                   const std::vector<std::size_t>& rows, const TransientError& error) {
  std::vector<double> sizes;
  for (const std::size_t i : rows)
    sizes.push_back(std::fabs(residuals[i]) / std::hypot(error.sigma, error.share * ways[i]));
  return median(sizes);
}

}  // namespace

std::vector<double> ways_to_go(const std::vector<StepRecord>& records) {
  std::vector<double> ways, steps;
  for (const StepRecord& record : records) {
    std::vector<double> way(record.rows(), 0.0), step(record.rows(), 0.0);
    for (const Plateau& plateau : plateaus_of(record)) {
      double most = 0.0;
      for (std::size_t i = plateau.begin; i < plateau.end; ++i)
        most = std::max(most, way[i] = std::fabs(record.Omega[i] - plateau.level));
      std::fill(step.begin() + static_cast<std::ptrdiff_t>(plateau.begin),
                step.begin() + static_cast<std::ptrdiff_t>(plateau.end), most);
    }
    ways.insert(ways.end(), way.begin(), way.end());
    steps.insert(steps.end(), step.begin(), step.end());
  }
  // Most rows of a step recording have settled.
  const double noise = std::max(median(ways) / kMedianOfNormal, kResolution * std::ranges::max(ways));
  for (std::size_t i = 0; i < ways.size(); ++i)
    ways[i] = std::sqrt(std::max(0.0, ways[i] - kSettled * noise) * steps[i]);
  return ways;
}

TransientError transient_error(std::span<const double> residuals, std::span<const double> ways) {
  std::vector<double> settled;
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (ways[i] > 0.0)
      moving.push_back(i);
    else
      settled.push_back(residuals[i]);
  }
  if (settled.size() < kFewestRowsScale || moving.size() < kFewestRowsScale) return {};
  TransientError error{.sigma = std::max(mad_scale(settled, 0.0), kResolution * std::ranges::max(ways))};
  const double chance = kMadSpread * std::sqrt(1.0 / static_cast<double>(moving.size()) +
                                               1.0 / static_cast<double>(settled.size()));
  if (median_size(residuals, ways, moving, error) < kMedianOfNormal * (1.0 + kEvidentScale * chance)) return error;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    error.share = 0.5 * (low + high);
    (median_size(residuals, ways, moving, error) > kMedianOfNormal ? low : high) = error.share;
  }
  return error;
}

std::vector<double> row_scales(const TransientError& error, std::span<const double> ways) {
  std::vector<double> scales(ways.size(), 1.0);
  if (error.share > 0.0)
    for (std::size_t i = 0; i < ways.size(); ++i)
      scales[i] = std::hypot(1.0, error.share * ways[i] / error.sigma);
  return scales;
}

}  // namespace ident
