// Draws blocks of windows with replacement.
#include "paired_bootstrap.h"

#include <algorithm>
#include <cmath>

#include "../random.h"

namespace field {
namespace {

double mean(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

}  // namespace

Comparison compare(const std::vector<double>& first, const std::vector<double>& second, int block,
                   int draws) {
  std::vector<double> difference;
  for (size_t i = 0; i < first.size(); ++i) difference.push_back(second[i] - first[i]);
  const int count = static_cast<int>(difference.size());
  const int length = std::min(block, count), blocks = std::max(1, count / length);
  Random random(1, 0, "bootstrap");
  std::vector<double> means;
  for (int draw = 0; draw < draws; ++draw) {
    double sum = 0;
    for (int b = 0; b < blocks; ++b) {
      const int from = random.integer(0, count - length);
      for (int i = from; i < from + length; ++i) sum += difference[static_cast<size_t>(i)];
    }
    means.push_back(sum / (blocks * length));
  }
  std::sort(means.begin(), means.end());
  const auto at = [&](double q) { return means[static_cast<size_t>(q * (draws - 1))]; };
  return {std::sqrt(mean(first)), std::sqrt(mean(second)), at(0.025), at(0.975)};
}

}  // namespace field
