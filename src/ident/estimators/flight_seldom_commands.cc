// Times at which commands come anew, and what is not known where these are far apart.
//
// Of vehicles flown at 1 kHz and logged more seldom (commands held), moments of inertia come out within 2 %
// as long as commands change from one to the next by less than 0.4 of what they change in the long run, 4 to
// 6 % off at 0.5 (50 Hz there), and 20 to 70 % off from 0.7 on (20 Hz), with intervals of 1 to 5 %.
#include "ident/estimators/flight_seldom_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/estimators/flight_impossible.h"
#include "ident/estimators/statistics.h"

namespace ident {
namespace {

constexpr double kSeldom = 1.0 / 49.0;  ///< s
constexpr double kHeld = 1.5;           ///< rows, or more, from change to change
constexpr double kTogether = 0.7;       ///< of the rotors change where one does
constexpr double kRough = 0.42;         ///< of what commands change in the long run
constexpr std::size_t kLongRun = 25;    ///< samples

struct Samples {
  std::vector<std::size_t> rows;  // that brought anything new
  double apart = 0.0;             // s, the median
};

double median_step(const std::vector<double>& t, const std::vector<std::size_t>& rows) {
  std::vector<double> d;
  for (std::size_t i = 1; i < rows.size(); ++i) d.push_back(t[rows[i]] - t[rows[i - 1]]);
  return d.empty() ? 0.0 : median(d);
}

// Where columns were sampled; where they are held in between, only those rows in which they change.
Samples samples_of(const std::vector<double>& t, std::span<const std::vector<double>> columns) {
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
  const double apart = median_step(t, sampled), held = median_step(t, changed);
  const bool together = changes > kTogether * static_cast<double>(changed.size() * columns.size());
  if (together && held > kHeld * apart) return {std::move(changed), held};
  return {std::move(sampled), apart};
}

bool are_rough(std::span<const FlightLog> logs) {
  return std::ranges::any_of(logs, [](const FlightLog& log) { return roughness(log) > kRough; });
}

// Between samples of what drives the motors, commands or measured speeds, in the log where it is longest;
// rows count too.
double longest_interval(const FlightRecord& record, std::span<const FlightLog> logs) {
  double longest = record.interval;
  for (const FlightLog& log : logs)
    if (const double interval = time_between(log.t, record.signals.commands ? log.delta : log.Omega);
        interval > longest)
      longest = interval;
  return longest;
}

}  // namespace

double time_between(const std::vector<double>& t, std::span<const std::vector<double>> columns) {
  const Samples anew = samples_of(t, columns);
  return anew.rows.size() < 2 ? kNaN : anew.apart;
}

double roughness(const FlightLog& log) {
  const std::vector<std::size_t> rows = samples_of(log.t, log.delta).rows;
  double next = 0, later = 0;
  for (std::size_t i = kLongRun; i < rows.size(); ++i)
    for (const std::vector<double>& delta : log.delta) {
      next += std::pow(delta[rows[i]] - delta[rows[i - 1]], 2);
      later += std::pow(delta[rows[i]] - delta[rows[i - kLongRun]], 2);
    }
  return later > 0 ? std::sqrt(next / later) : 0.0;
}

bool commands_are_seldom(const FlightLog& log) {
  return log.has_commands() && time_between(log.t, log.delta) > kSeldom;
}

std::optional<Warning> seldom_input(const FlightRecord& record, std::span<const FlightLog> logs) {
  const double interval = longest_interval(record, logs);
  if (!(interval > std::max(kSeldom, kHeld * record.interval))) return {};
  const bool commands = record.signals.commands;
  return Warning{commands ? "seldom_commands" : "seldom_speeds",
                 fmt::format("{} come at {:.3g} Hz, rows at {:.3g} Hz: what the motors {} in between was not "
                             "logged; log {} at 100 Hz or more",
                             commands ? "commands" : "rotor speeds", 1 / interval, 1 / record.interval,
                             commands ? "were told" : "did", commands ? "commands" : "them")};
}

std::optional<double> hides_motion(const FlightRecord& record, std::span<const FlightLog> logs) {
  const double interval = longest_interval(record, logs);
  if (!record.signals.commands || !(interval > kSeldom) || !are_rough(logs)) return {};
  return interval;
}

void doubt_seldom_commands(Result& result, const FlightRecord& record, std::span<const FlightLog> logs) {
  if (!record.signals.commands) return;
  const bool early = std::ranges::any_of(result.parameters, is_before_its_command);
  const bool seldom = longest_interval(record, logs) > kSeldom;
  if (!early && !seldom) return;
  constexpr const char* kWhy = "what the motors were told between commands that far apart was not logged";
  doubt_all(result, {"omega_m", "zeta_m", "dead_time", "Jp"}, kWhy);
  if (!are_rough(logs) && !(early && seldom)) return;
  doubt_all(result, {"Jxx", "Jyy", "Jzz", "Jxy", "Jxz", "Jyz"}, kWhy);
  if (result.has_warning("command_offset")) doubt_all(result, {"km", "Omega_0", "kT", "kQ"}, kWhy);
}

}  // namespace ident
