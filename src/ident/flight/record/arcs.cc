// Finds the rows of a log in flight, and the holes that cut them.
#include "ident/flight/record/arcs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kGroundShare = 0.25;  ///< of the median collective; below it the vehicle is on the ground
constexpr double kPushOver = 0.5;      ///< s; a shorter time below it belongs to flight
constexpr double kLiftOff = 1.0;       ///< s after and before the ground, in which the ground may push
// With missing rows commands are missing: a gap of so many usual steps, and of at least so many seconds, ends
// an arc.
constexpr double kMissedRows = 5.0, kShortestGap = 0.03;
constexpr double kEnoughLeft = 0.3;  // least share of the flight in such pieces

// Collective per row: mean command, or mean squared rotor speed.
std::vector<double> collective(const FlightLog& log) {
  std::vector<double> sum(log.rows(), 0.0);
  const auto& columns = log.has_commands() ? log.delta : log.Omega;
  std::vector<double> last(columns.size(), 0.0);
  for (std::size_t i = 0; i < log.rows(); ++i)
    for (std::size_t n = 0; n < columns.size(); ++n) {
      if (std::isfinite(columns[n][i])) last[n] = columns[n][i];
      sum[i] += last[n] * (log.has_commands() ? 1.0 : last[n]);
    }
  return sum;
}

// Rows in flight: inside a window that was chosen, else where the rotors turn well above idle between takeoff
// and landing.
std::vector<bool> in_flight(const FlightLog& log, std::vector<Warning>& warnings) {
  std::vector<bool> fly(log.rows(), log.windows.empty());
  for (const auto& window : windows_off_ground(log))
    for (std::size_t i = 0; i < log.rows(); ++i)
      if (log.t[i] >= window[0] && log.t[i] <= window[1]) fly[i] = true;
  if (!log.windows.empty() && !log.windows_found) return fly;
  const std::vector<double> level = collective(log);
  std::vector<double> turning;
  for (const double x : level)
    if (x > 0) turning.push_back(x);
  const double threshold = kGroundShare * median(turning);
  std::size_t grounded = 0;
  double quiet_until = -1e300;
  for (std::size_t i = 0; i < log.rows();) {
    const auto low = [&](std::size_t row) { return !(level[row] > threshold); };
    std::size_t end = i + 1;
    while (end < log.rows() && low(end) == low(i)) ++end;
    const bool pushed_over = i > 0 && end < log.rows() && log.t[end] - log.t[i] < kPushOver;
    if (low(i) && !pushed_over) {
      quiet_until = log.t[end - 1] + kLiftOff;
      for (std::size_t k = i; k > 0 && log.t[i] - log.t[k - 1] < kLiftOff && fly[k - 1]; --k)
        fly[k - 1] = false, ++grounded;
    }
    for (; i < end; ++i)
      if (log.t[i] < quiet_until && fly[i]) fly[i] = false, ++grounded;
  }
  if (grounded > 0 && grounded < log.rows()) {
    warnings.push_back(
        {"ground_excluded", fmt::format("{}: {:.1f} s with rotors at rest or just started are not used. "
                                        "State windows in a map file to choose the rows yourself.",
                                        log.file,
                                        static_cast<double>(grounded) * (log.t.back() - log.t.front()) /
                                            static_cast<double>(log.rows()))});
  }
  return fly;
}

// Empty rows and jumps of time end an arc when they last. What the motors do in the first `history` seconds
// after a jump, or after the start of the log, was commanded before it and is not in the log.
Pieces pieces(const FlightLog& log, std::vector<bool> fly, double gap, double history) {
  double known_from = log.t.front() + history;
  const auto breaks_before = [&](std::size_t i) {
    return i > 0 &&
           (log.t[i] - log.t[i - 1] > gap || std::ranges::find(log.breaks, log.t[i - 1]) != log.breaks.end());
  };
  for (std::size_t i = 0; i < log.rows() && history > 0; ++i) {
    if (breaks_before(i)) known_from = log.t[i] + history;
    if (log.t[i] < known_from) fly[i] = false;
  }
  Pieces out;
  std::size_t begin = 0;
  bool open = false;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    if (open && (breaks_before(i) || !fly[i])) {
      out.emplace_back(begin, i);
      open = false;
    }
    if (!open && fly[i]) begin = i, open = true;
  }
  if (open) out.emplace_back(begin, log.rows());
  std::erase_if(out, [&](const auto& p) {
    return log.t[p.second - 1] - log.t[p.first] < 0.3 || p.second - p.first < 8;
  });
  return out;
}

// Usual time between rows that hold a command: messages of several sensors come in rows of their own.
double usual_step(const FlightLog& log) {
  std::vector<double> steps;
  double last = kNaN;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    if (std::ranges::none_of(log.delta, [&](const auto& c) { return std::isfinite(c[i]); })) continue;
    if (std::isfinite(last)) steps.push_back(log.t[i] - last);
    last = log.t[i];
  }
  return median(steps);
}

double seconds_of(const FlightLog& log, const Pieces& all) {
  double sum = 0;
  for (const auto& [begin, end] : all) sum += log.t[end - 1] - log.t[begin];
  return sum;
}

}  // namespace

Pieces whole_pieces(const FlightLog& log, double history, double longest_gap,
                    std::vector<Warning>& warnings) {
  std::vector<bool> fly = in_flight(log, warnings);
  for (const auto& [from, until] : log.left_out)
    for (std::size_t i = 0; i < log.rows(); ++i)
      if (log.t[i] >= from && log.t[i] < until) fly[i] = false;
  Pieces loose = pieces(log, fly, longest_gap, history);
  if (loose.empty()) {
    warnings.push_back(
        {"log_not_used", log.file + ": no uninterrupted part of 0.3 s or more with turning rotors, so "
                                    "nothing of it is used. Check commands, windows and gaps in the time."});
    return loose;
  }
  if (!log.has_commands()) return loose;
  const double gap =
      std::clamp(kMissedRows * usual_step(log), std::min(kShortestGap, longest_gap), longest_gap);
  Pieces strict = pieces(log, fly, gap, history);
  if (seconds_of(log, strict) > kEnoughLeft * seconds_of(log, loose)) return strict;
  warnings.push_back(
      {"holes_bridged",
       fmt::format(
           "{}: rows are missing so often that under 30 % of the flight lies between the holes. Commands are "
           "held over holes of up to {:.2g} s, which may bias motors and inertia. Log without dropouts.",
           log.file, longest_gap)});
  return loose;
}

}  // namespace ident
