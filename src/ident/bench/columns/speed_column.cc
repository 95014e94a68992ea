// Preference of the speed columns, and the comparison of those that are there.
#include "ident/bench/columns/speed_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "ident/core/format_number.h"
#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr std::array kColumns = {"omega", "omega_optical", "omega_electrical"};
constexpr double kSameSpeed = 0.03;  // ratio of two speeds that agree
constexpr double kRatioTolerance = 0.015;
constexpr int kLargestRatio = 14;  // pole pairs of common motors

const Column* column_of(const NumberTable& table, std::string_view name) {
  const auto at = std::ranges::find(table.columns, name, &Column::name);
  return at == table.columns.end() ? nullptr : &*at;
}

std::size_t turning_samples(const std::vector<double>& values) {
  return static_cast<std::size_t>(
      std::ranges::count_if(values, [](double v) { return std::isfinite(v) && v != 0.0; }));
}

std::string contents(const Column& column) {
  const auto known = std::ranges::count_if(column.values, [](double v) { return std::isfinite(v); });
  if (known == 0) return fmt::format("'{}' is empty", column.header);
  if (turning_samples(column.values) == 0) return fmt::format("'{}' is zero throughout", column.header);
  return fmt::format("'{}' has {} values that are not zero", column.header, turning_samples(column.values));
}

/// Median of other/chosen over the rows in which both turn.
double median_ratio(const std::vector<double>& other, const std::vector<double>& chosen) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (std::fabs(chosen[i]) > 0.0 && std::fabs(other[i]) > 0.0)
      ratios.push_back(std::fabs(other[i] / chosen[i]));
  return ratios.size() < kFewestTurning ? kNaN : median(ratios);
}

void compare(const NumberTable& table, const Column& chosen, std::vector<Warning>& warnings) {
  for (const char* name : kColumns) {
    const Column* other = column_of(table, name);
    if (!other || other == &chosen) continue;
    const double ratio = median_ratio(other->values, chosen.values);
    if (!std::isfinite(ratio) || std::fabs(ratio - 1.0) < kSameSpeed) continue;
    const SmallRatio small = small_ratio(ratio, kLargestRatio, kRatioTolerance);
    if (small.p == 0)
      warnings.push_back(
          {"speeds_disagree", fmt::format("{}: '{}' is {} times '{}', which is used", table.file,
                                          other->header, format_number(ratio), chosen.header)});
    else
      warnings.push_back(
          {"pole_count",
           fmt::format("{}: '{}' is {}/{} of '{}', which is used: a wrong number of poles (or of marks on "
                       "the rotor). Were the other speed true, speeds and km would be {} times as large, kT "
                       "and kQ {} "
                       "times; check the one setting and the other",
                       table.file, other->header, small.p, small.q, chosen.header, format_number(ratio, 3),
                       format_number(1.0 / (ratio * ratio), 3))});
  }
}

}  // namespace

SmallRatio small_ratio(double ratio, int largest, double tolerance) {
  SmallRatio best;
  for (int sum = 2; sum <= 2 * largest && best.p == 0; ++sum)
    for (int p = std::max(1, sum - largest); p <= std::min(largest, sum - 1); ++p) {
      const int q = sum - p;
      if (std::gcd(p, q) == 1 && std::fabs(ratio * q / p - 1.0) < tolerance) best = {p, q};
    }
  return best;
}

std::string speed_columns_in_words(const NumberTable& table) {
  std::string text;
  for (const char* name : kColumns)
    if (const Column* column = column_of(table, name)) text += (text.empty() ? "" : ", ") + contents(*column);
  return text.empty() ? "no such column holds a value" : text;
}

const Column* speed_column(const NumberTable& table, std::vector<Warning>& warnings) {
  for (const char* name : kColumns) {
    const Column* column = column_of(table, name);
    if (!column || turning_samples(column->values) < kFewestTurning) continue;
    compare(table, *column, warnings);
    return column;
  }
  return nullptr;
}

}  // namespace ident
