// Medians over settled and over moving rows; spikes against the lines through their neighbours.
#include "ident/bench/motor/motor_step_misfit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ident/bench/motor/motor_step_plateaus.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kMedianOfNormal = 0.674489750196082;  // of |x|
constexpr double kSettled = 3.0;                       // noise levels within which a row has settled
constexpr std::size_t kFewestRows = 10;                // of either kind
constexpr double kMadSpread = 1.17;  // relative standard deviation of a MAD scale times sqrt(n), normal noise
constexpr double kResolution = 1e-6;    // of the largest step: no speed is known better
constexpr double kEvidentMisfit = 4.0;  // standard deviations
constexpr double kStandsOut = 3.0;      // ranges of its four neighbours that a spike lies off
constexpr double kSpan = 2.06;          // range of four normal values

}  // namespace

MovingRows moving_rows(const std::vector<StepRecord>& records) {
  std::vector<double> way, step;
  for (const StepRecord& record : records) {
    std::vector<double> own_way(record.rows(), 0.0), own_step(record.rows(), 0.0);
    for (const Plateau& plateau : plateaus_of(record)) {
      double most = 0.0;
      for (std::size_t i = plateau.begin; i < plateau.end; ++i)
        most = std::max(most, own_way[i] = std::fabs(record.Omega[i] - plateau.level));
      std::fill(own_step.begin() + static_cast<std::ptrdiff_t>(plateau.begin),
                own_step.begin() + static_cast<std::ptrdiff_t>(plateau.end), most);
    }
    way.insert(way.end(), own_way.begin(), own_way.end());
    step.insert(step.end(), own_step.begin(), own_step.end());
  }
  if (way.empty()) return {};
  // Most rows of a step recording have settled.
  const double noise = std::max(median(way) / kMedianOfNormal, kResolution * std::ranges::max(way));
  for (std::size_t i = 0; i < way.size(); ++i)
    if (way[i] <= kSettled * noise) step[i] = 0.0;
  return {std::move(step), noise};
}

TransientMisfit transient_misfit(std::span<const double> residuals, const MovingRows& rows) {
  std::vector<double> settled, moving, shares;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (rows.step[i] > 0.0) {
      moving.push_back(std::fabs(residuals[i]));
      shares.push_back(std::fabs(residuals[i]) / rows.step[i]);
    } else {
      settled.push_back(residuals[i]);
    }
  }
  if (settled.size() < kFewestRows || moving.size() < kFewestRows) return {};
  // A fit that transients pull about misses the plateaus by more than their own scatter.
  TransientMisfit misfit{.sigma = std::clamp(mad_scale(settled, 0.0), 0.5 * rows.noise, rows.noise)};
  const double chance = kMadSpread * std::sqrt(1.0 / static_cast<double>(moving.size()) +
                                               1.0 / static_cast<double>(settled.size()));
  if (median(moving) > kMedianOfNormal * misfit.sigma * (1.0 + kEvidentMisfit * chance))
    misfit.share = median(shares) / kMedianOfNormal;
  return misfit;
}

std::vector<bool> lone_spikes(const std::vector<StepRecord>& records, double noise) {
  std::vector<bool> spikes;
  for (const StepRecord& record : records) {
    const std::vector<double>& Omega = record.Omega;
    for (std::size_t i = 0; i < Omega.size(); ++i) {
      double miss = std::numeric_limits<double>::infinity(), low = miss, high = -miss;
      const auto look = [&](std::size_t near, std::size_t far) {
        miss = std::min(miss, std::fabs(Omega[i] - 2.0 * Omega[near] + Omega[far]));
        low = std::min({low, Omega[near], Omega[far]});
        high = std::max({high, Omega[near], Omega[far]});
      };
      if (i >= 2) look(i - 1, i - 2);
      if (i + 2 < Omega.size()) look(i + 1, i + 2);
      spikes.push_back(miss > kStandsOut * std::max(high - low, kSpan * noise));
    }
  }
  return spikes;
}

}  // namespace ident
