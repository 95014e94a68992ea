// Makes the rows of a sweep from a table.
#include "ident/bench/thrust/thrust_sweep_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>

#include "ident/bench/thrust/thrust_sweep_speed.h"
#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr std::size_t kFewestOfALog = 200;
constexpr double kSlowestLog = 0.25;  // s between samples of the speed
constexpr double kSpikeOfFullSpeed = 0.02;
constexpr double kRest = 0.005;           // of full speed: below it the rotor does not turn
constexpr std::size_t kFewestAtRest = 3;  // rows in a row; fewer may be a speed that the sensor missed
constexpr double kSettle = 1.0;           // s

std::vector<double> values_of(const NumberTable& table, std::string_view name) {
  const std::vector<double>* found = table.find(name);
  if (!found || std::ranges::none_of(*found, [](double v) { return std::isfinite(v); })) return {};
  return *found;
}

double largest(const std::vector<double>& values) {
  double top = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) top = std::max(top, v);
  return top;
}

/// Median time between samples of the speed; NaN when the file is no log.
double sampling_time(const std::vector<double>& t, const std::vector<double>& Omega) {
  std::vector<double> steps;
  double last = kNaN;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t[i]) || !std::isfinite(Omega[i])) continue;
    if (std::isfinite(last)) steps.push_back(t[i] - last);
    last = t[i];
  }
  return steps.size() < kFewestOfALog ? kNaN : median(steps);
}

void reorder(SweepRows& rows, const std::vector<std::size_t>& order) {
  for (std::vector<double>* column :
       {&rows.place, &rows.Omega, &rows.thrust, &rows.torque, &rows.delta, &rows.voltage, &rows.current}) {
    if (column->empty()) continue;
    std::vector<double> sorted;
    for (const std::size_t i : order) sorted.push_back((*column)[i]);
    *column = std::move(sorted);
  }
}

/// Rows in order of time; rows without a time are left out.
void sort_by_time(SweepRows& rows) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::isfinite(rows.place[i])) order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rows.place[i]; });
  reorder(rows, order);
}

std::vector<double> command_of(const NumberTable& table, const std::optional<CommandRange>& range) {
  std::vector<double> delta = values_of(table, "delta");
  if (!delta.empty()) return delta;
  std::vector<double> u = values_of(table, "u");
  if (range)
    for (double& v : u) v = (v - range->min_us) / (range->max_us - range->min_us);
  return u;  // without a range only good to tell set-points apart
}

/// The command from which on the rotor turns: nine of ten rows in which it does have more. NaN without
/// commands.
double turning_command(const SweepRows& rows, double standing) {
  std::vector<double> commands;
  for (std::size_t i = 0; i < rows.delta.size(); ++i)
    if (rows.Omega[i] > standing && std::isfinite(rows.delta[i])) commands.push_back(rows.delta[i]);
  if (commands.empty()) return kNaN;
  const auto at = commands.begin() + static_cast<std::ptrdiff_t>(commands.size() / 10);
  std::ranges::nth_element(commands, at);
  return *at;
}

/// A rotor stands where its speed is zero in several rows on end, or its command is zero. Where the command
/// is one at which it turns elsewhere the sensor missed it.
void find_rest(SweepRows& rows, bool command_is_delta) {
  const double standing = kRest * largest(rows.Omega), turning = turning_command(rows, standing);
  rows.at_rest.assign(rows.size(), false);
  for (std::size_t i = 0; i < rows.size();) {
    std::size_t end = i;
    while (end < rows.size() && rows.Omega[end] <= standing) ++end;
    for (std::size_t k = i; k < end; ++k) {
      const bool commanded = command_is_delta && !rows.delta.empty() && rows.delta[k] <= 0.0;
      const bool missed = !rows.delta.empty() && rows.delta[k] > turning;
      rows.at_rest[k] = commanded || (end - i >= kFewestAtRest && !missed);
      if (!rows.at_rest[k]) {
        ++(missed ? rows.missed : rows.doubtful_rest);
        rows.Omega[k] = kNaN;
      }
    }
    i = std::max(end, i + 1);
  }
}

void read_columns(SweepRows& rows, const NumberTable& table, const std::optional<CommandRange>& command) {
  rows.file = table.file;
  rows.thrust = values_of(table, "thrust");
  rows.torque = values_of(table, "torque");
  rows.delta = command_of(table, command);
  rows.voltage = values_of(table, "voltage");
  rows.current = values_of(table, "current");
  if (rows.thrust.empty()) throw DataError(table.file + ": the column of the thrust holds no value");
}

void prepare_log(SweepRows& rows, double step) {
  sort_by_time(rows);
  rows.spikes = remove_speed_spikes(rows.Omega, kSpikeOfFullSpeed * largest(rows.Omega));
  rows.filled = fill_gaps(rows.Omega, rows.place, 5.0 * step);
}

/// Largest less smallest of the values in a window that moves forwards; gaps in the values do not count.
class MovingRange {
 public:
  explicit MovingRange(const std::vector<double>& values) : values_(values) {}
  void take_in(std::size_t i) {
    if (!std::isfinite(values_[i])) return;
    while (!low_.empty() && values_[low_.back()] >= values_[i]) low_.pop_back();
    while (!high_.empty() && values_[high_.back()] <= values_[i]) high_.pop_back();
    low_.push_back(i), high_.push_back(i);
  }
  void drop_before(std::size_t first) {
    while (!low_.empty() && low_.front() < first) low_.pop_front();
    while (!high_.empty() && high_.front() < first) high_.pop_front();
  }
  double span() const { return low_.empty() ? 0.0 : values_[high_.front()] - values_[low_.front()]; }

 private:
  const std::vector<double>& values_;
  std::deque<std::size_t> low_, high_;  // candidates for the extremes, in order
};

}  // namespace

SweepRows sweep_rows(const NumberTable& table, const std::optional<CommandRange>& command,
                     std::vector<Warning>& warnings) {
  SweepRows rows;
  SweepSpeed speed = sweep_speed(table, warnings);
  rows.Omega = std::move(speed.Omega);
  rows.speed_column = speed.column;
  read_columns(rows, table, command);
  const std::vector<double> t = values_of(table, "t");
  const double step = t.empty() ? kNaN : sampling_time(t, rows.Omega);
  rows.is_log = step <= kSlowestLog;
  if (rows.is_log) {
    rows.place = t;
    prepare_log(rows, step);
  } else {
    rows.place.resize(rows.size());
    std::iota(rows.place.begin(), rows.place.end(), 1.0);
  }
  const bool has_delta = table.find("delta") || command;
  find_rest(rows, has_delta);
  if (rows.is_log)
    number_dwells(rows, kSettle);
  else
    number_repeats(rows);
  if (has_delta) return rows;
  rows.pulse_without_range = !rows.delta.empty();
  rows.delta.clear();
  return rows;
}

void number_dwells(SweepRows& rows, double settle) {
  constexpr double ahead = 0.1;  // s, for what the sensors' clocks are apart
  std::vector<double> seen, difference;
  for (const double v : rows.Omega)
    if (std::isfinite(v)) seen.push_back(v);
  for (std::size_t i = 1; i < seen.size(); ++i) difference.push_back(seen[i] - seen[i - 1]);
  const double noise = mad_scale(difference, 0.0) / std::sqrt(2.0);
  const double tolerance = std::max(0.012 * largest(rows.Omega), 8.0 * noise);
  rows.set_point.assign(rows.size(), -1);
  rows.set_points = 0;
  double start = kNaN;
  MovingRange range(rows.Omega);
  for (std::size_t i = 0, behind = 0, beyond = 0; i < rows.size(); ++i) {
    while (beyond < rows.size() && (beyond <= i || rows.place[beyond] <= rows.place[i] + ahead))
      range.take_in(beyond++);
    while (rows.place[behind] < rows.place[i] - settle) ++behind;
    range.drop_before(behind);
    if (!std::isfinite(rows.Omega[i])) continue;
    const bool steady = range.span() <= tolerance && rows.place[i] - rows.place.front() >= settle;
    if (!steady) {
      start = kNaN;
      continue;
    }
    if (!(std::fabs(rows.Omega[i] - start) <= tolerance)) {
      start = rows.Omega[i];
      ++rows.set_points;
    }
    rows.set_point[i] = rows.set_points - 1;
  }
}

void number_repeats(SweepRows& rows) {
  rows.set_point.assign(rows.size(), -1);
  rows.set_points = 0;
  const bool commanded = !rows.delta.empty();
  // Without commands: steps between neighbours fall into two heaps, within and between set-points.
  double within = -1.0;
  if (!commanded) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (const double step = std::fabs(rows.Omega[i] - rows.Omega[i - 1]); std::isfinite(step))
        steps.push_back(step);
    std::ranges::sort(steps);
    double widest = 4.0;  // ratio that no single heap has in its middle
    for (std::size_t i = steps.size() / 4; i + 2 < steps.size(); ++i) {
      const double ratio = steps[i + 1] / std::max(steps[i], 1e-9 * steps.back());
      if (ratio > widest)
        widest = ratio, within = std::sqrt(std::max(steps[i], 1e-9 * steps.back()) * steps[i + 1]);
    }
  }
  std::size_t previous = rows.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(rows.Omega[i]) || rows.at_rest[i]) continue;
    const bool same =
        previous < rows.size() && (commanded ? std::fabs(rows.delta[i] - rows.delta[previous]) < 1e-9
                                             : std::fabs(rows.Omega[i] - rows.Omega[previous]) <= within);
    rows.set_point[i] = same ? rows.set_points - 1 : rows.set_points++;
    previous = i;
  }
}

}  // namespace ident
