// The tare as a broken line through the stays at rest, each weighted by its uncertainty.
#include "ident/bench/thrust/thrust_sweep_tare.h"

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kEvident = 3.0;  // standard deviations between stays that are a drift

}  // namespace

RestStay rest_stay(double place, std::span<const double> readings) {
  const RobustMean found = robust_mean(readings);
  const std::vector<double> rho = autocorrelation(readings, 1);
  const double r = rho.size() > 1 ? std::clamp(rho[1], 0.0, 0.99) : 0.0;
  const double independent = std::max(1.0, static_cast<double>(found.used) * (1.0 - r) / (1.0 + r));
  return {place, found.value, found.scale / std::sqrt(independent)};
}

TareDrift::TareDrift(std::vector<RestStay> stays) : stays_(std::move(stays)) {
  double largest = 0.0, weights = 0.0;
  for (const RestStay& s : stays_) largest = std::max(largest, s.std);
  for (const RestStay& s : stays_) {
    const double w = 1.0 / std::max(s.std * s.std, std::max(1e-12 * largest * largest, 1e-300));
    mean_ += w * s.value, weights += w;
  }
  mean_ /= weights;
  std_ = 1.0 / std::sqrt(weights);
  for (std::size_t i = 1; i < stays_.size(); ++i)
    drifts_ = drifts_ || std::fabs(stays_[i].value - stays_[i - 1].value) >
                             kEvident * std::hypot(stays_[i].std, stays_[i - 1].std);
  if (!drifts_) return;
  const auto [low, high] = std::ranges::minmax(stays_, {}, &RestStay::value);
  std::vector<double> values;
  for (const RestStay& s : stays_) values.push_back(s.value);
  mean_ = ident::mean(values);
  std_ = std::hypot(std_, (high.value - low.value) / std::sqrt(12.0));
}

double TareDrift::deviation(double place) const {
  if (!drifts_) return 0.0;
  if (place <= stays_.front().place) return stays_.front().value - mean_;
  for (std::size_t i = 1; i < stays_.size(); ++i) {
    const RestStay &a = stays_[i - 1], &b = stays_[i];
    if (place <= b.place)
      return a.value + (place - a.place) / (b.place - a.place) * (b.value - a.value) - mean_;
  }
  return stays_.back().value - mean_;
}

}  // namespace ident
