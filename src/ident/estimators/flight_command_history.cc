// A command that is held over lost rows is late by half of these: of 300 losses of 2 to 4 rows in 40 s the
// motors come out 1 % too fast.
#include "ident/estimators/flight_command_history.h"

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/estimators/statistics.h"

namespace ident {
namespace {

constexpr double kLost = 1.6;     // usual steps without a row, or more: some are lost
constexpr double kLongest = 0.1;  // s: beyond it the line tells nothing
constexpr double kRegular = 0.2;  // at most that share of steps is long, else that is how it was logged

struct Samples {
  std::vector<double> t, delta;
};

Samples samples_of(const FlightLog& log, const std::vector<double>& column) {
  Samples out;
  for (std::size_t i = 0; i < log.rows(); ++i)
    if (std::isfinite(column[i])) out.t.push_back(log.t[i]), out.delta.push_back(column[i]);
  if (out.t.empty()) out = {{log.t.front()}, {0.0}};
  return out;
}

bool is_hole(double step, double usual) { return step > kLost * usual && step < kLongest; }

bool is_regular(const std::vector<double>& t, double usual) {
  std::size_t holes = 0;
  for (std::size_t i = 1; i < t.size(); ++i) holes += is_hole(t[i] - t[i - 1], usual);
  return static_cast<double>(holes) < kRegular * static_cast<double>(t.size());
}

}  // namespace

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

std::vector<HeldCommand> command_history(const FlightLog& log, double from, double to) {
  const double usual = usual_step(log);
  std::vector<HeldCommand> history;
  for (const std::vector<double>& column : log.delta) {
    const auto [t, delta] = samples_of(log, column);
    const bool fill = is_regular(t, usual);
    HeldCommand command;
    const auto before = std::ranges::upper_bound(t, from) - t.begin();
    for (auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(before - 1, 0)); i < t.size(); ++i) {
      command.append(t[i], delta[i]);
      if (t[i] > to) break;
      if (!fill || i + 1 == t.size() || !is_hole(t[i + 1] - t[i], usual)) continue;
      const double lost = std::round((t[i + 1] - t[i]) / usual);
      for (double k = 1; k < lost; ++k)
        command.append(t[i] + k / lost * (t[i + 1] - t[i]), delta[i] + k / lost * (delta[i + 1] - delta[i]));
    }
    history.push_back(std::move(command));
  }
  return history;
}

}  // namespace ident
