// Ranges that the protocols of speed controllers have; they overlap only where a column does not use its
// range.
#include "ident/io/csv/command_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ident/io/csv/units.h"

namespace ident {
namespace {

constexpr double kShortestPulse = 700.0, kLongestPulse = 2500.0;                     // us, of servo signals
constexpr double kShortestOneShot = 120.0, kLongestOneShot = 260.0, kOneShot = 8.0;  // us, us, -
constexpr double kDshotCommands = 47.0, kDshotRange = 2000.0, kDshotTop = 2047.0;
constexpr double kPercent = 100.0, kFullCommand = 1.5;  // the latter: as a fraction, with some room

/// Smallest value that is not zero, largest value, and whether all are whole numbers.
struct Range {
  double low = 0.0, high = 0.0;
  bool whole = true, negative = false;
};

std::optional<Range> range_of(const std::vector<double>& values) {
  std::optional<Range> range;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    if (!range) range = Range{.low = kLongestPulse * 1e3};
    range->negative = range->negative || v < 0.0;
    range->whole = range->whole && v == std::round(v);
    range->high = std::max(range->high, v);
    if (v > 0.0) range->low = std::min(range->low, v);
  }
  return range && range->high > 0.0 && !range->negative ? range : std::nullopt;
}

enum class Scale { pulse, one_shot, dshot, percent, fraction, unknown };

Scale scale_of(const Range& range) {
  if (range.low >= kShortestPulse && range.high <= kLongestPulse) return Scale::pulse;
  if (range.high <= kFullCommand) return Scale::fraction;
  if (range.high <= kPercent) return Scale::percent;
  if (range.low >= kShortestOneShot && range.high <= kLongestOneShot) return Scale::one_shot;
  if (range.whole && range.high <= kDshotTop) return Scale::dshot;
  return Scale::unknown;
}

void multiply(std::vector<double>& values, double factor) {
  for (double& v : values) v *= factor;
}

void say(NumberTable& table, const Column& column, const Range& range, const char* what) {
  table.warnings.push_back(
      {"command_scale", fmt::format("{}: '{}' holds {:.5g} to {:.5g}: taken as {}", table.file, column.header,
                                    range.low, range.high, what)});
}

void take_dshot(Column& column) {
  for (double& v : column.values)
    if (std::isfinite(v)) v = std::max(0.0, (v - kDshotCommands) / kDshotRange);
  column.name = "delta";
}

void recognise(NumberTable& table, Column& column) {
  const std::optional<Range> range = range_of(column.values);
  if (!range) return;
  const bool is_pulse = column.name == "u";
  switch (scale_of(*range)) {
    case Scale::pulse:
      if (is_pulse) return;
      say(table, column, *range, "pulse widths in us");
      column.name = "u";
      return;
    case Scale::one_shot:
      say(table, column, *range, "OneShot125 pulses, eight times as short as others: 1000 us are 125");
      multiply(column.values, kOneShot);
      column.name = "u";
      return;
    case Scale::dshot:
      say(table, column, *range, "DShot throttle: delta = (value - 47)/2000");
      take_dshot(column);
      return;
    case Scale::percent:
      say(table, column, *range, "percent");
      multiply(column.values, 0.01);
      column.name = "delta";
      return;
    case Scale::fraction:
      if (!is_pulse) return;
      say(table, column, *range, "a command from 0 to 1");
      column.name = "delta";
      return;
    case Scale::unknown:
      return;
  }
}

}  // namespace

void recognise_commands(NumberTable& table) {
  const bool has_both = table.find("u") && table.find("delta");
  for (Column& column : table.columns) {
    if (has_both || (column.name != "u" && column.name != "delta")) continue;
    // A unit that is stated for a fraction has been applied; `us` is also written above other protocols.
    if (column.name == "delta" && split_header(column.header).unit) continue;
    recognise(table, column);
  }
}

}  // namespace ident
