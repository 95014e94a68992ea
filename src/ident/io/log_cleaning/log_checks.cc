// What the numbers of a flight log say about its units and frames.
#include "ident/io/log_cleaning/log_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/io/log_cleaning/log_rows.h"

namespace ident {
namespace {

constexpr double kHeldShare = 0.5;      // of the rows that repeat the row before: then it is no new sample
constexpr double kFrozen = 0.15;        // s at one value of a sensor that else changes with every row
constexpr double kChanges = 0.9;        // of its rows
constexpr double kSlowestLog = 0.5;     // s between rows; slower is a log in other units, or of no use
constexpr double kSlowestStated = 5.0;  // the same where the unit was stated
constexpr double kFastestLog = 2e-5;    // s between rows in the mean: no log has 50 000 a second
constexpr double kLongGap = 10.0;       // times the usual step
constexpr double kShortestGap = 0.1;    // s

/// Whether a column holds noise: its second differences then change sign from row to row more often than not.
bool is_noisy(const std::vector<double>& column, const std::vector<std::size_t>& rows) {
  constexpr double kAlternates = 0.4;  // two thirds do in white noise, none in what a formula gives
  double before = 0;
  std::size_t changes = 0, count = 0;
  for (std::size_t k = 2; k < rows.size(); ++k) {
    const double bend = column[rows[k]] - 2 * column[rows[k - 1]] + column[rows[k - 2]];
    if (before != 0 && bend != 0) ++count, changes += (bend > 0) != (before > 0);
    before = bend;
  }
  return static_cast<double>(changes) > kAlternates * static_cast<double>(count);
}

}  // namespace

void drop_constant(FlightLog& log, Components sensor, const std::string& name) {
  const std::vector<std::size_t> rows = rows_of(sensor);
  if (sensor.front().empty()) return;
  if (rows.empty()) return clear_all(sensor);
  if (rows.size() < kFewRows) return;
  const auto constant = [&](std::span<const std::vector<double>> part) {
    return std::ranges::all_of(rows, [&](std::size_t i) { return same(part, i, rows.front()); });
  };
  if (constant(sensor)) {
    clear_all(sensor);
    log.warnings.push_back(
        {"constant_signal", fmt::format("{}: {}: never changes; taken as not measured", log.file, name)});
    return;
  }
  if (sensor.size() != 3) return;  // a quaternion without one of its four is none
  // A flight in a plane, as a formula gives it, has constants as well.
  if (std::ranges::none_of(sensor, [&](const auto& c) { return is_noisy(c, rows); })) return;
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::isnan(sensor[k][rows.front()]) || !constant(sensor.subspan(k, 1))) continue;
    for (double& v : sensor[k]) v = kNaN;
    log.warnings.push_back(
        {"constant_signal",
         fmt::format("{}: {}: the {} of them never changes, the others do; it is taken as not measured",
                     log.file, name, std::array{"first", "second", "third"}[k])});
  }
}

void drop_held(FlightLog& log, Components sensor, const std::string& name) {
  const std::vector<std::size_t> rows = rows_of(sensor);
  if (rows.size() < kFewRows) return;
  std::vector<std::size_t> held;
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (same(sensor, rows[k], rows[k - 1])) held.push_back(rows[k]);
  const double share = static_cast<double>(held.size()) / static_cast<double>(rows.size());
  if (share <= kHeldShare) return;
  for (const std::size_t i : held)
    for (std::vector<double>& c : sensor) c[i] = kNaN;
  log.warnings.push_back(
      {"held_samples",
       fmt::format("{}: {}: {:.0f} % of the rows only repeat the row before; they count as not "
                   "sampled",
                   log.file, name, 100.0 * share)});
}

namespace {

/// Whether another sensor changes with most rows of [first, last]: a vehicle at rest stands still in all of
/// them.
bool moves_meanwhile(const FlightLog& log, Components sensor, std::size_t first, std::size_t last) {
  const auto changes = [&](std::span<const std::vector<double>> other) {
    if (other.empty() || other.front().empty() || other.front().data() == sensor.front().data()) return false;
    std::size_t count = 0;
    for (std::size_t i = first + 1; i <= last; ++i) count += same(other, i, i - 1) ? 0 : 1;
    return static_cast<double>(count) > 0.5 * static_cast<double>(last - first);
  };
  return changes(log.w_B) || changes(log.f_B) || changes(log.q_WB) || changes(log.x_W) || changes(log.v_W);
}

}  // namespace

void drop_frozen(FlightLog& log, Components sensor, const std::string& name) {
  const std::vector<std::size_t> rows = rows_of(sensor);
  std::vector<std::pair<std::size_t, std::size_t>> runs;  // places in `rows`, of the first value and the last
  std::size_t held = 0, frozen = 0;
  double longest = 0, at = 0;
  for (std::size_t k = 0, end = 0; k < rows.size(); k = end) {
    for (end = k + 1; end < rows.size() && same(sensor, rows[end], rows[k]);) ++end;
    held += end - k - 1;
    const double seconds = log.t[rows[end - 1]] - log.t[rows[k]];
    if (seconds < kFrozen || end - k < kFewRows) continue;
    if (!moves_meanwhile(log, sensor, rows[k], rows[end - 1])) continue;
    runs.emplace_back(k, end - 1), frozen += end - k - 1;
    if (seconds > longest) longest = seconds, at = log.t[rows[k]];
  }
  const std::size_t others = rows.size() - frozen;
  if (runs.empty() || static_cast<double>(held - frozen) > (1 - kChanges) * static_cast<double>(others))
    return;
  for (const auto& [first, last] : runs)
    for (std::size_t k = first + 1; k <= last; ++k)
      for (std::vector<double>& c : sensor) c[rows[k]] = kNaN;
  log.warnings.push_back(
      {"frozen_signal",
       fmt::format("{}: {}: stands still at one value {} time{}, the longest for {:.3g} s from t = {:.6g} s, "
                   "and else changes with every row; those rows count as not sampled",
                   log.file, name, runs.size(), runs.size() == 1 ? "" : "s", longest, at)});
}

void tell_rates(FlightLog& log, const std::vector<NamedSensor>& sensors) {
  std::vector<std::pair<std::string, std::string>> by_rate;
  for (const NamedSensor& sensor : sensors) {
    const std::vector<std::size_t> rows = rows_of(sensor.components);
    if (rows.size() < 2) continue;
    std::vector<double> steps;
    for (std::size_t k = 1; k < rows.size(); ++k) steps.push_back(log.t[rows[k]] - log.t[rows[k - 1]]);
    const std::string rate = fmt::format("{:.3g} Hz", 1.0 / *middle_of(steps));
    auto at = std::ranges::find(by_rate, rate, &std::pair<std::string, std::string>::first);
    if (at == by_rate.end()) at = by_rate.insert(at, {rate, ""});
    at->second += (at->second.empty() ? "" : ", ") + sensor.name;
  }
  std::string text;
  for (const auto& [rate, names] : by_rate)
    text += (text.empty() ? "" : "; ") + fmt::format("{} at {}", names, rate);
  if (!text.empty()) log.notices.push_back(log.file + ": " + text);
}

void check_time(FlightLog& log, long header_line, bool unit_stated) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < log.t.size(); ++i) steps.push_back(log.t[i] - log.t[i - 1]);
  const std::optional<double> usual = middle_of(steps);
  if (!usual) throw DataError(log.file + ": t: the log holds a single row");
  if (*usual > kSlowestLog && !unit_stated)
    throw InputError(
        log.file, header_line, "t",
        fmt::format("the usual step of t is {:.4g}: if that is not seconds, name the unit in the header, "
                    "as in 't [ms]'",
                    *usual));
  const double mean = (log.t.back() - log.t.front()) / static_cast<double>(steps.size());
  if (*usual > kSlowestStated || mean < kFastestLog)
    throw InputError(
        log.file, header_line, "t",
        fmt::format("rows come {:.3g} s apart{}, and no flight is logged like that: is it in "
                    "another one (s, ms, us, ns)?",
                    std::max(*usual, mean), unit_stated ? " by the unit that was stated" : ", if t is in s"));
  const double limit = std::max(kShortestGap, kLongGap * *usual);
  const auto gaps = std::ranges::count_if(steps, [&](double step) { return step > limit; });
  if (gaps == 0) return;
  const auto longest = std::ranges::max_element(steps);
  log.warnings.push_back(
      {"time_gap", fmt::format("{}: t: {} gaps; the longest is {:.3g} s at t = {:.6g} s", log.file, gaps,
                               *longest, log.t[static_cast<std::size_t>(longest - steps.begin())])});
}

void check_voltage(FlightLog& log, long header_line, double voltage_of_km) {
  for (double& v : log.vbat)
    if (!(v > 0)) v = kNaN;
  if (std::ranges::all_of(log.vbat, [](double v) { return std::isnan(v); })) log.vbat.clear();
  constexpr double kLeast = 0.4, kMostChecks = 2.0;  // of it: no battery flies with less, or has more
  const double usual = middle_of(log.vbat).value_or(voltage_of_km);
  if (usual > kLeast * voltage_of_km && usual < kMostChecks * voltage_of_km) return;
  throw InputError(log.file, header_line, "vbat",
                   fmt::format("is {:.3g} V mostly, and battery_voltage of the vehicle file {:.3g} V: one of "
                               "them is in another unit, or of another battery; without vbat the log can be "
                               "used as it is",
                               usual, voltage_of_km));
}

void check_specific_force(FlightLog& log, long header_line, double gravity) {
  const std::vector<std::size_t> rows = rows_of(log.f_B);
  if (rows.size() < kFewRows) return;
  std::vector<double> sizes;
  for (const std::size_t i : rows) sizes.push_back(norm(log.f_B, i));
  const double size = middle_of(sizes).value_or(gravity);
  const double down = middle_of(log.f_B[2]).value_or(-gravity);
  if (size > 0.7 && size < 1.4 && gravity > 5.0)
    throw InputError(
        log.file, header_line, "ax, ay, az",
        fmt::format("their size is {:.3g} mostly: that is in g; name the unit in the header, as in 'az [g]'",
                    size));
  if (size < 0.3 * gravity || (size < 0.7 * gravity && std::abs(down) < 0.2 * gravity))
    log.warnings.push_back(
        {"gravity_missing",
         fmt::format(
             "{}: ax, ay, az: their size is {:.3g} m/s^2 mostly, and {:.3g} along z, far from gravity: an "
             "acceleration with gravity removed is no specific force",
             log.file, size, down)});
  else if (down > 0.5 * gravity)
    throw InputError(
        log.file, header_line, "az",
        fmt::format("is {:+.3g} m/s^2 mostly, but at rest a specific force points up, {:.3g}: body axes "
                    "that point left and up need a map with 'frames: {{body: flu}}'",
                    down, -gravity));
}

}  // namespace ident
