// Tables to step records: which column is speed, what the command was, where the recording pauses.
#include "ident/bench/motor/motor_step_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/bench/columns/speed_column.h"
#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kPauseIntervals = 50.0;  // a pause is as long as so many usual intervals, and over a second
constexpr double kShortestPause = 1.0;    // s
constexpr double kLongestInterval = 1.0;  // s between rows in which an answer can be seen
constexpr std::size_t kFewestRowsRecord = 12;
constexpr std::size_t kSmoothingRows = 100;  // to either side

/// Refuses what no motor's answer can be seen in.
void expect_motion(const NumberTable& table, const std::vector<double>& speed, const std::vector<double>& t) {
  double low = kNaN, high = kNaN;
  for (const double v : speed) low = std::fmin(low, v), high = std::fmax(high, v);
  if (!(high > low)) throw DataError(table.file + ": the speed is the same in every row");
  std::vector<double> intervals;
  for (std::size_t i = 1; i < t.size(); ++i)
    if (t[i] > t[i - 1]) intervals.push_back(t[i] - t[i - 1]);
  if (const double usual = median(intervals); usual > kLongestInterval)
    throw DataError(
        fmt::format("{}: t: rows are {:.3g} s apart, and a motor answers within a second: name the unit of "
                    "the time in the header (as in 't [ms]'), or sample at 50 Hz or more",
                    table.file, usual));
}

/// Turned round where it is negative: a stand may count either sense of rotation so.
std::vector<double> speed_of(const NumberTable& table, std::vector<Warning>& warnings) {
  const Column* column = speed_column(table, warnings);
  if (!column)
    throw DataError(fmt::format("{}: the motor never turns ({})", table.file, speed_columns_in_words(table)));
  if (column->name != "omega")
    warnings.push_back(
        {"speed_column", fmt::format("{}: the speed is taken from '{}'", table.file, column->header)});
  std::vector<double> speed = column->values;
  const double usual = median(speed);
  if (usual < 0.0)
    for (double& v : speed) v = -v;
  return speed;
}

/// Command of each row; a row without one repeats the command before it.
std::vector<double> command_of(const NumberTable& table, const std::optional<CommandRange>& range,
                               std::vector<Warning>& warnings) {
  std::vector<double> delta;
  if (const std::vector<double>* column = table.find("delta")) {
    delta = *column;
  } else if (const std::vector<double>* pulse_us = table.find("u")) {
    const CommandRange used = range.value_or(CommandRange{});
    if (!range)
      warnings.push_back(
          {"command_range",
           fmt::format("{}: no vehicle file says which pulse widths mean 0 and 1; {} and {} us are "
                       "taken",
                       table.file, used.min_us, used.max_us)});
    for (const double u : *pulse_us) delta.push_back((u - used.min_us) / (used.max_us - used.min_us));
  } else {
    throw DataError(table.file + ": there is neither delta nor u");
  }
  for (std::size_t i = 1; i < delta.size(); ++i)
    if (std::isnan(delta[i])) delta[i] = delta[i - 1];
  return delta;
}

double usual_interval(const std::vector<double>& t) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < t.size(); ++i) intervals.push_back(t[i] - t[i - 1]);
  return mean(intervals);
}

/// The edges of a command sampled at t.
std::vector<CommandEdge> edges_of(const std::vector<double>& t, const std::vector<double>& delta) {
  std::vector<CommandEdge> edges = {{t.front(), delta.front(), false}};
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (delta[i] == edges.back().delta) continue;
    if (t[i] == edges.back().t && edges.size() > 1)
      edges.pop_back();  // of rows with one time the last counts
    if (t[i] == edges.back().t)
      edges.back().delta = delta[i];
    else
      edges.push_back({t[i], delta[i], delta[i] < edges.back().delta});
  }
  return edges;
}

}  // namespace

std::vector<StepRecord> step_records(const NumberTable& table, const std::optional<CommandRange>& range,
                                     std::vector<Warning>& warnings) {
  const std::vector<double>* time = table.find("t");
  if (!time) throw DataError(table.file + ": there is no time");
  const std::vector<double> speed = speed_of(table, warnings);
  expect_motion(table, speed, *time);
  const std::vector<double> command = command_of(table, range, warnings);
  const double pause = std::max(kShortestPause, kPauseIntervals * usual_interval(*time));

  std::vector<StepRecord> records;
  std::vector<double> t, delta;  // of every row of the recording, measured or not
  StepRecord record{.file = table.file};
  const auto finish = [&] {
    if (record.rows() >= kFewestRowsRecord) {
      record.edges = edges_of(t, delta);
      records.push_back(record);
    }
    record = {.file = table.file};
    t.clear();
    delta.clear();
  };
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (!std::isfinite(command[i]) || !std::isfinite((*time)[i])) continue;
    if (!t.empty() && (*time)[i] - t.back() > pause) finish();
    t.push_back((*time)[i]);
    delta.push_back(command[i]);
    if (!std::isfinite(speed[i])) continue;
    record.t.push_back((*time)[i]);
    record.Omega.push_back(speed[i]);
    record.delta.push_back(command[i]);
  }
  finish();
  const bool any_edge = std::ranges::any_of(records, [](const StepRecord& r) { return r.edges.size() > 1; });
  if (!any_edge)
    throw DataError(table.file + ": the command never changes (or there are fewer than 12 rows)");
  return records;
}

bool has_bunched_times(const StepRecord& record) {
  const double usual = usual_interval(record.t);
  std::size_t close = 0;
  for (std::size_t i = 1; i < record.rows(); ++i) close += record.t[i] - record.t[i - 1] < 0.25 * usual;
  return close > record.rows() / 4;
}

StepRecord with_even_times(const StepRecord& record) {
  // A straight line through the times of the rows around each row, over so many that bursts average out.
  StepRecord even = record;
  const std::size_t n = record.rows();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t first = i > kSmoothingRows ? i - kSmoothingRows : 0;
    const std::size_t last = std::min(n - 1, i + kSmoothingRows);
    const double middle = 0.5 * static_cast<double>(first + last);
    double sum = 0.0, slope = 0.0, squares = 0.0;
    for (std::size_t k = first; k <= last; ++k) {
      const double d = static_cast<double>(k) - middle;
      sum += record.t[k];
      slope += d * record.t[k];
      squares += d * d;
    }
    even.t[i] =
        sum / static_cast<double>(last - first + 1) + slope / squares * (static_cast<double>(i) - middle);
    if (i > 0) even.t[i] = std::max(even.t[i], even.t[i - 1]);
  }
  even.edges = edges_of(even.t, even.delta);
  return even;
}

}  // namespace ident
