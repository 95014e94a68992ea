// What refinement, verification and diagnosis begin with.
#include "ident/flight/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/core/stage_times.h"
#include "ident/flight/checks/command_rate.h"
#include "ident/flight/checks/commands_vs_speeds.h"
#include "ident/flight/checks/log_self_test.h"
#include "ident/flight/checks/rotor_speed_jitter.h"
#include "ident/flight/conditioning/align_streams.h"
#include "ident/flight/conditioning/decimate_filtered.h"
#include "ident/flight/conditioning/rotor_vibration.h"
#include "ident/flight/fit/input_sensitivity.h"
#include "ident/flight/make_record.h"

namespace ident {
namespace {

double mean_of_used(const std::vector<double>& column) {
  double sum = 0, n = 0;
  for (const double x : column)
    if (std::isfinite(x) && x > 0) sum += x, n += 1;
  return n > 0 ? sum / n : kNaN;
}

// The first log whose commands are seldom, where rotor speeds came at least twice as often in all such logs.
const FlightLog* seldom_beside_speeds(std::span<const FlightLog> logs) {
  const FlightLog* first = nullptr;
  for (const FlightLog& log : logs) {
    if (!commands_are_seldom(log)) continue;
    if (!(2 * new_samples(log.t, log.Omega).apart < new_samples(log.t, log.delta).apart)) return nullptr;
    if (!first) first = &log;
  }
  return first;
}

// Commands of all logs or of none: where those of one are missing, or were left out as not the right ones,
// rotor speeds serve as input for all; and where commands are seldom and speeds are not. Empty where nothing
// has to be changed.
std::vector<FlightLog> with_like_inputs(std::span<const FlightLog> logs, std::vector<Warning>& warnings) {
  if (std::ranges::none_of(logs, &FlightLog::has_commands)) return {};
  const bool speeds = std::ranges::all_of(logs, &FlightLog::has_rotor_speeds);
  std::vector<bool> commands;
  if (const FlightLog* seldom = speeds ? seldom_beside_speeds(logs) : nullptr) {
    warnings.push_back(
        {"seldom_commands",
         fmt::format("{}: new commands come below 49 Hz, rotor speeds at least twice as often. Rotor speeds "
                     "are the input, and the motors are not estimated. Log every command{}.",
                     seldom->file, logs.size() > 1 ? ", or give the other logs alone" : "")});
    return without_commands(logs);
  }
  for (const FlightLog& log : logs) {
    const bool contradict = log.has_commands() && commands_contradict_speeds(log);
    commands.push_back(log.has_commands() && !contradict);
    if (!contradict) continue;
    const std::string what = fmt::format(
        "{}: no rotor follows any of the commands, whatever the lag of the motors: commands or rotor speeds "
        "are not those of this flight",
        log.file);
    if (!speeds) throw DataError(what + "; the speeds cannot serve instead, for another log has none");
    warnings.push_back(
        {"commands_contradict_speeds",
         what + ". The speeds are the input, and the motors are not estimated. Check both columns."});
  }
  const auto commanded = std::ranges::count(commands, true);
  if (commanded == std::ssize(logs) || !speeds) return {};
  const auto without = logs.begin() + (std::ranges::find(commands, false) - commands.begin());
  if (commanded > 0)
    warnings.push_back(
        {"commands_left_out",
         fmt::format("{} has no usable commands. Rotor speeds are the input of all logs, and the motors are "
                     "not estimated. Give the other logs alone to estimate them.",
                     without->file)});
  return without_commands(logs);
}

std::vector<Warning> found_by_reading(std::span<const FlightLog> logs, const std::string& code) {
  std::vector<Warning> found;
  for (const FlightLog& log : logs)
    std::ranges::copy_if(log.warnings, std::back_inserter(found),
                         [&](const Warning& w) { return w.code == code; });
  return found;
}

}  // namespace

std::vector<double> starting_constants(const Vehicle& vehicle, std::span<const FlightLog> logs,
                                       std::vector<Warning>& warnings) {
  Vehicle start = vehicle;
  const auto assume = [&](const std::string& name, double value, const std::string& how) {
    if (start.has(name) && start.value(name) > 0) return;
    start.parameters[name].value = value;
    warnings.push_back({"assumed_start", fmt::format("{}: not given, the search starts at {} ({})", name,
                                                     format_number(value), how)});
  };
  if (!start.has("m")) throw UsageError(vehicle.file + ": mass: needed, no flight can tell it from kT");
  const double weight = start.value("m") * vehicle.g, rotors = static_cast<double>(vehicle.rotors.size());
  double level = kNaN, speed = kNaN, arm = 0;
  for (const FlightLog& log : logs) {
    for (const auto& c : log.delta) level = std::isfinite(level) ? level : mean_of_used(c);
    for (const auto& c : log.Omega) speed = std::isfinite(speed) ? speed : mean_of_used(c);
  }
  for (const Rotor& r : vehicle.rotors) arm = std::max(arm, r.r_B.head<2>().norm());
  if (!std::isfinite(speed))
    speed = start.has("kT") && start.value("kT") > 0  ? std::sqrt(weight / (rotors * start.value("kT")))
            : start.has("km") && std::isfinite(level) ? start.value("km") * level
                                                      : 800.0;
  assume("kT", weight / (rotors * speed * speed), "hover at the mean rotor speed");
  assume("kQ", 0.015 * std::max(arm / 0.15, 0.3) * start.value("kT"), "a usual ratio to kT");
  if (std::isfinite(level)) assume("km", speed / level, "hover at the mean command");
  assume("omega_m", 20.0 * (start.has("zeta_m") ? start.value("zeta_m") : 1.0), "a usual motor's lag, 0.1 s");
  const double J = start.value("m") * std::pow(0.4 * arm, 2);
  assume("Jxx", J, "mass within 0.4 arm lengths");
  assume("Jyy", J, "mass within 0.4 arm lengths");
  assume("Jzz", 1.7 * J, "mass within 0.4 arm lengths");
  return parameter_vector(start);
}

FlightEntry enter_flight(const Vehicle& vehicle, std::span<const FlightLog> given, Result& result) {
  const Stage stage("enter logs and check them");
  const std::vector<FlightLog> alike = with_like_inputs(given, result.warnings);
  const std::span<const FlightLog> given_logs = alike.empty() ? given : std::span<const FlightLog>(alike);
  const auto tell = [&](const std::vector<Warning>& warnings) {
    result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
  };
  FlightEntry entry;
  tell(vehicle.warnings);
  entry.p = starting_constants(vehicle, given_logs, result.warnings);
  entry.record = make_flight_record(vehicle, entry.p, given_logs);
  const std::vector<FlightLog> still =
      without_vibration(entry.record, given_logs, entry.vibration, result.warnings);
  const std::span<const FlightLog> logs = still.empty() ? given_logs : std::span<const FlightLog>(still);
  if (!still.empty()) entry.record = make_flight_record(vehicle, entry.p, logs);
  const auto [aligned, turns_apart] = aligned_streams(entry.record, logs, vehicle.g, result.warnings);
  const std::span<const FlightLog> in_time = aligned.empty() ? logs : std::span<const FlightLog>(aligned);
  const std::vector<FlightLog> white = whitened_sensors(in_time, result.warnings);
  if (const auto& moved = white.empty() ? aligned : white; !moved.empty())
    entry.record = make_flight_record(vehicle, entry.p, moved);
  entry.record.turns_apart = turns_apart;
  for (const FlightLog& log : logs) {
    result.inputs.push_back(log.file);
    tell(log.warnings);
  }
  tell(entry.record.warnings);
  if (has_noisy_input(entry.record))
    result.warn("speeds_as_input",
                "The logs have no commands: measured rotor speeds are the input, after smoothing. What "
                "depends on the smoothing widens the intervals, and a diagnosis hardly tells their noise "
                "from a gap. Log the commands too.");
  entry.tested = found_by_reading(logs, "wrong_frame");
  if (!entry.tested.empty()) return entry;  // and told
  entry.tested = self_test(entry.record, logs, vehicle, entry.p);
  tell(entry.tested);
  return entry;
}

}  // namespace ident
