// Finds the rows at which columns change, and the spread of their increments.
#include "ident/data/sampling.h"

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kTogether = 0.7;     ///< of the rotors change where one does
constexpr double kEven = 0.3;         ///< of the usual time from change to change: as far as others are
constexpr double kMostEven = 0.6;     ///< of them are that near
constexpr std::size_t kLongRun = 25;  ///< samples

std::vector<double> steps_of(const std::vector<double>& t, const std::vector<std::size_t>& rows) {
  std::vector<double> d;
  for (std::size_t i = 1; i < rows.size(); ++i) d.push_back(t[rows[i]] - t[rows[i - 1]]);
  return d;
}

// Holding is periodic; commands in coarse steps change now and then.
bool are_even(const std::vector<double>& steps, double usual) {
  const auto near =
      std::ranges::count_if(steps, [&](double step) { return std::abs(step - usual) < kEven * usual; });
  return static_cast<double>(near) > kMostEven * static_cast<double>(steps.size());
}

}  // namespace

NewSamples new_samples(const std::vector<double>& t, std::span<const std::vector<double>> columns) {
  std::vector<std::size_t> sampled, changed;
  double changes = 0;
  for (std::size_t i = 0; i < t.size() && !columns.empty(); ++i) {
    if (std::ranges::any_of(columns, [&](const auto& c) { return std::isnan(c[i]); })) continue;
    const auto moved =
        sampled.empty()
            ? std::ssize(columns)
            : std::ranges::count_if(columns, [&](const auto& c) { return c[i] != c[sampled.back()]; });
    if (moved > 0) changed.push_back(i), changes += static_cast<double>(moved);
    sampled.push_back(i);
  }
  if (sampled.size() < 2) return {std::move(sampled), kNaN};
  const double apart = median(steps_of(t, sampled));
  const bool together = changes > kTogether * static_cast<double>(changed.size() * columns.size());
  if (!together || changed.size() < 2) return {std::move(sampled), apart};
  const std::vector<double> steps = steps_of(t, changed);
  const double held = median(steps);
  if (!(held > kHeldRows * apart) || !are_even(steps, held)) return {std::move(sampled), apart};
  return {std::move(changed), held};
}

double roughness(const FlightLog& log) {
  const std::vector<std::size_t> rows = new_samples(log.t, log.delta).rows;
  double next = 0, later = 0;
  for (std::size_t i = kLongRun; i < rows.size(); ++i)
    for (const std::vector<double>& delta : log.delta) {
      next += std::pow(delta[rows[i]] - delta[rows[i - 1]], 2);
      later += std::pow(delta[rows[i]] - delta[rows[i - kLongRun]], 2);
    }
  return later > 0 ? std::sqrt(next / later) : 0.0;
}

}  // namespace ident
