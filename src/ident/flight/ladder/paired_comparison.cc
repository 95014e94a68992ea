// Differences of squared errors, summed up over blocks.
#include "ident/flight/ladder/paired_comparison.h"

#include <cmath>
#include <map>

#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kBlock = 1.0;      // s: the longest horizon
constexpr std::size_t kFewest = 5;  // blocks for a test
constexpr double kPlainly = 1.25;   // ratio of errors that needs no test

}  // namespace

bool worse_beyond_chance(const std::vector<WindowErrors>& a, const std::vector<WindowErrors>& b,
                         Metric metric, std::size_t horizon, double level) {
  const double of_a = error_of(a, metric, horizon), of_b = error_of(b, metric, horizon);
  if (!(of_a > of_b)) return false;
  std::map<std::pair<std::size_t, long>, double> blocks;
  for (std::size_t w = 0; w < a.size(); ++w) {
    const double x = a[w].of[static_cast<std::size_t>(metric)][horizon],
                 y = b[w].of[static_cast<std::size_t>(metric)][horizon];
    if (std::isfinite(x) && std::isfinite(y))
      blocks[{a[w].arc, std::lround(std::floor(a[w].t / kBlock))}] += x * x - y * y;
  }
  if (blocks.size() < kFewest) return of_a > kPlainly * of_b;
  std::vector<double> sums;
  for (const auto& [block, sum] : blocks) sums.push_back(sum);
  const double n = static_cast<double>(sums.size());
  return mean(sums) > t_quantile(1 - level, n - 1) * standard_deviation(sums) / std::sqrt(n);
}

}  // namespace ident
