// Differences and ratios of squared errors, summed up over blocks.
#include "ident/flight/ladder/paired_comparison.h"

#include <cmath>
#include <map>

#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kBlock = 1.0;  // s: the longest horizon

// Whether the mean of these is above zero beyond chance, by a t test on one side.
bool is_above_zero(const std::vector<double>& x, double level) {
  if (x.size() < 2) return false;
  const double n = static_cast<double>(x.size());
  return mean(x) > t_quantile(1 - level, n - 1) * standard_deviation(x) / std::sqrt(n);
}

}  // namespace

bool worse_beyond_chance(const std::vector<WindowErrors>& a, const std::vector<WindowErrors>& b,
                         Metric metric, std::size_t horizon, double level) {
  const double of_a = error_of(a, metric, horizon), of_b = error_of(b, metric, horizon);
  if (!(of_a > of_b)) return false;
  std::map<std::pair<std::size_t, long>, std::pair<double, double>> blocks;
  for (std::size_t w = 0; w < a.size(); ++w) {
    const double x = a[w].of[static_cast<std::size_t>(metric)][horizon],
                 y = b[w].of[static_cast<std::size_t>(metric)][horizon];
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    auto& [sum_a, sum_b] = blocks[{a[w].arc, std::lround(std::floor(a[w].t / kBlock))}];
    sum_a += x * x, sum_b += y * y;
  }
  std::vector<double> differences, ratios;
  for (const auto& [block, sums] : blocks) {
    differences.push_back(sums.first - sums.second);
    if (sums.first > 0 && sums.second > 0) ratios.push_back(std::log(sums.first / sums.second));
  }
  return is_above_zero(differences, level / 2) || is_above_zero(ratios, level / 2);
}

}  // namespace ident
