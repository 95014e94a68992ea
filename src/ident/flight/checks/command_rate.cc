// Times at which commands come anew, and what is not known where these are far apart.
//
// Of vehicles flown at 1 kHz and logged more seldom (commands held), moments of inertia come out within 2 %
// as long as commands change from one to the next by less than 0.4 of what they change in the long run, 4 to
// 6 % off at 0.5 (50 Hz there), and 20 to 70 % off from 0.7 on (20 Hz), with intervals of 1 to 5 %.
#include "ident/flight/checks/command_rate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"
#include "ident/flight/checks/implausible_estimates.h"

namespace ident {
namespace {

constexpr double kSeldom = 1.0 / 49.0;  ///< s
constexpr double kEarly = 1.0 / 110.0;  ///< s, where rotors turn before their commands
constexpr double kRarer = 1.5;          ///< times the time between samples of rates
constexpr double kRough = 0.42;         ///< of what commands change in the long run

double interval_of(const FlightRecord& record, const FlightLog& log) {
  const double interval = new_samples(log.t, record.signals.commands ? log.delta : log.Omega).apart;
  return interval > 0 ? interval : record.interval;  // NaN too
}

bool is_seldom_and_rough(const FlightRecord& record, const FlightLog& log, double interval) {
  return interval_of(record, log) > interval && roughness(log) > kRough;
}

}  // namespace

bool commands_are_seldom(const FlightLog& log) {
  return log.has_commands() && new_samples(log.t, log.delta).apart > kSeldom;
}

bool commands_are_rarer_than_rates(const FlightLog& log) {
  return log.has_commands() && log.has_rates() &&
         new_samples(log.t, log.delta).apart > kRarer * new_samples(log.t, log.w_B).apart;
}

double input_interval(const FlightRecord& record, std::span<const FlightLog> logs) {
  double longest = 0;
  for (const FlightLog& log : logs) longest = std::max(longest, interval_of(record, log));
  return longest;
}

std::optional<Warning> seldom_input(const FlightRecord& record, std::span<const FlightLog> logs) {
  const auto by_interval = [&](const FlightLog& log) { return interval_of(record, log); };
  const auto most = std::ranges::max_element(logs, {}, by_interval);
  const double interval = by_interval(*most);
  if (!(interval > std::max(kSeldom, kHeldRows * record.interval))) return {};
  const bool commands = record.signals.commands;
  return Warning{
      commands ? "seldom_commands" : "seldom_speeds",
      fmt::format("{}: new {} come at {:.3g} Hz, and what the motors {} in between was not logged. {}. Log "
                  "them at 100 Hz or more{}.",
                  most->file, commands ? "commands" : "rotor speeds", 1 / interval,
                  commands ? "were told" : "did",
                  commands ? "Motor constants are not identifiable, nor is inertia if commands change roughly"
                           : "kQ, Jp and inertia are not identifiable",
                  logs.size() > 1 ? ", or give other logs alone" : "")};
}

std::optional<double> hides_motion(const FlightRecord& record, std::span<const FlightLog> logs) {
  if (!record.signals.commands) return {};
  for (const FlightLog& log : logs)
    if (is_seldom_and_rough(record, log, kSeldom)) return interval_of(record, log);
  return {};
}

void doubt_seldom_commands(Result& result, const FlightRecord& record, std::span<const FlightLog> logs) {
  if (!record.signals.commands) return;
  const bool early = std::ranges::any_of(result.parameters, is_before_its_command);
  const bool seldom = input_interval(record, logs) > kSeldom;
  const auto rough_beyond = [&](double interval) {
    return std::ranges::any_of(
        logs, [&](const FlightLog& log) { return is_seldom_and_rough(record, log, interval); });
  };
  constexpr const char* kWhy = "what the motors were told between commands that far apart was not logged";
  if (seldom) doubt_all(result, {"omega_m", "zeta_m", "dead_time", "Jp"}, kWhy);
  if (!(seldom && early) && !rough_beyond(early ? kEarly : kSeldom)) return;
  doubt_all(result, {"Jxx", "Jyy", "Jzz", "Jxy", "Jxz", "Jyz", "kQ"}, kWhy);
  if (result.has_warning("command_offset")) doubt_all(result, {"km", "Omega_0", "kT", "kQ"}, kWhy);
}

}  // namespace ident
