// Choice of the speed column, pole count, spikes.
#include "ident/bench/thrust/thrust_sweep_speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr std::array kColumns = {"omega", "omega_optical", "omega_electrical"};
constexpr std::size_t kFewest = 3;   // samples off zero that make a column usable
constexpr double kSameSpeed = 0.03;  // ratio of two speeds that agree
constexpr double kRatioTolerance = 0.015;
constexpr int kLargestRatio = 14;  // pole pairs of common motors
constexpr std::ptrdiff_t kMedianReach = 7;

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

[[noreturn]] void refuse(const NumberTable& table) {
  std::string text;
  for (const char* name : kColumns)
    if (const Column* column = column_of(table, name)) text += (text.empty() ? "" : ", ") + contents(*column);
  throw DataError(fmt::format(
      "{}: no usable rotor speed ({}): kT and kQ need the speed of the rotor in at least {} rows at which it "
      "turns; connect the optical or the electrical sensor, or name the column omega or rpm",
      table.file, text.empty() ? "no such column holds a value" : text, kFewest));
}

/// Median of other/chosen over the rows in which both turn.
double median_ratio(const std::vector<double>& other, const std::vector<double>& chosen) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (std::fabs(chosen[i]) > 0.0 && std::fabs(other[i]) > 0.0)
      ratios.push_back(std::fabs(other[i] / chosen[i]));
  return ratios.size() < kFewest ? kNaN : median(ratios);
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
                       "the rotor). With the other speed kT and kQ would be {} times as large; check the one "
                       "setting and the other",
                       table.file, other->header, small.p, small.q, chosen.header,
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

std::size_t remove_speed_spikes(std::vector<double>& Omega, double least) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < Omega.size(); ++i)
    if (std::isfinite(Omega[i])) rows.push_back(i);
  const auto n = static_cast<std::ptrdiff_t>(rows.size());
  std::vector<double> seen;
  for (const std::size_t i : rows) seen.push_back(Omega[i]);
  std::size_t spikes = 0;
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, k - kMedianReach),
                         to = std::min(n, k + kMedianReach + 1);
    const std::span<const double> window(seen.data() + from, static_cast<std::size_t>(to - from));
    const double middle = median(window);
    const auto at = static_cast<std::size_t>(k);
    if (std::fabs(seen[at] - middle) <= std::max(least, 6.0 * mad_scale(window, middle))) continue;
    Omega[rows[at]] = middle;
    ++spikes;
  }
  return spikes;
}

std::size_t fill_gaps(std::vector<double>& values, const std::vector<double>& place, double longest) {
  std::size_t filled = 0;
  for (std::size_t i = 1; i < values.size();) {
    if (std::isfinite(values[i]) || !std::isfinite(values[i - 1])) {
      ++i;
      continue;
    }
    std::size_t next = i;
    while (next < values.size() && !std::isfinite(values[next])) ++next;
    if (next == values.size()) break;
    const double span = place[next] - place[i - 1];
    for (std::size_t k = i; k < next && span <= longest; ++k, ++filled) {
      const double part = span > 0.0 ? (place[k] - place[i - 1]) / span : 0.5;
      values[k] = values[i - 1] + part * (values[next] - values[i - 1]);
    }
    i = next + 1;
  }
  return filled;
}

SweepSpeed sweep_speed(const NumberTable& table, std::vector<Warning>& warnings) {
  const Column* chosen = nullptr;
  for (const char* name : kColumns) {
    const Column* column = column_of(table, name);
    if (!chosen && column && turning_samples(column->values) >= kFewest) chosen = column;
  }
  if (!chosen) refuse(table);
  compare(table, *chosen, warnings);
  SweepSpeed speed{.Omega = chosen->values, .column = chosen->header};
  for (double& v : speed.Omega)
    if (v < 0.0) v = -v;  // the sense of rotation of a stand says nothing of the propeller
  return speed;
}

}  // namespace ident
