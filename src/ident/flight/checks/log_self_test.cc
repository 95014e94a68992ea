// The self-test of a log: frames and motor order first, then whether there is enough in it.
#include "ident/flight/checks/log_self_test.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "ident/core/parallel.h"
#include "ident/core/statistics.h"
#include "ident/flight/checks/command_rate.h"
#include "ident/flight/checks/rotor_order.h"
#include "ident/flight/checks/sensor_frames.h"

namespace ident {
namespace {

constexpr double kShortest = 15.0;        ///< s of flight
constexpr double kSlowest = 1.0 / 49.0;   ///< s between rows
constexpr double kSaturatedShare = 0.02;  ///< of the rows
constexpr double kToTell = 10.0;          ///< standard errors of a slope: an inertia to 10 %
constexpr double kSteadyThrust = 0.01;    ///< spread over mean
constexpr double kFarOff = 4.0;           ///< thrust over weight, or weight over thrust

void test_excitation(const RotorAgreement& rotors, std::vector<Warning>& findings) {
  if (rotors.windows == 0) return;
  constexpr std::array names = {"roll", "pitch", "yaw"};
  std::vector<std::string> still;
  for (std::size_t k = 0; k < 3; ++k) {
    const double r = std::abs(rotors.correlation[k]);
    if (r * std::sqrt(rotors.windows) < kToTell * std::sqrt(1 - r * r)) still.emplace_back(names[k]);
  }
  if (still.size() == 3 && rotors.thrust_variation < kSteadyThrust)
    findings.push_back(
        {"hover_only",
         fmt::format(
             "The rates do not follow the commands about any axis, and thrust varies by less than "
             "{:.0f} %. Inertia and motor constants stay as stated. Fly doublets or a multisine about "
             "every axis, 20 s or more.",
             100 * kSteadyThrust)});
  else if (!still.empty())
    findings.push_back(
        {"no_excitation",
         fmt::format(
             "{}: the commands hardly turn the vehicle about this axis (below {:.0f} standard errors). "
             "Its moment of inertia is poorly known. Add doublets or a multisine about it.",
             fmt::join(still, ", "), kToTell)});
}

/// Thrust of the rotors as stated over the weight, in the mean of the flight; by measured speeds where these
/// are the input.
double thrust_over_weight(const FlightRecord& record, double gravity, std::span<const double> p) {
  double sum = 0, rows = 0;
  for (const FlightArc& arc : record.arcs) {
    if (record.signals.commands)
      for (const MotorState<double>& motor : arc.motors) sum += std::pow(motor.Omega, 2);
    else
      for (const std::vector<double>& speeds : arc.inputs->Omega)
        for (const double Omega : speeds) sum += std::pow(Omega, 2);
    rows += static_cast<double>(arc.rows());
  }
  return p[param::kT] * sum / (rows * p[param::m] * gravity);
}

/// What speeds in another unit than rad/s look like: thrust goes with their square.
std::string unit_of_speeds(double ratio) {
  constexpr double kPerMinute = 60 / (2 * std::numbers::pi), kNear = 1.25;
  const auto is = [&](double factor) {
    const double off = std::sqrt(ratio) / factor;
    return off > 1 / kNear && off < kNear;
  };
  if (is(1 / kPerMinute)) return "; so would speeds in rad/s that are taken for turns a minute";
  if (is(kPerMinute)) return "; so would speeds in turns a minute that are taken for rad/s";
  return "";
}

void test_weight(const FlightRecord& record, double gravity, std::span<const double> p,
                 std::vector<Warning>& findings) {
  const double ratio = thrust_over_weight(record, gravity, p);
  if (!(ratio > 0) || (ratio > 1 / kFarOff && ratio < kFarOff)) return;
  const bool commands = record.signals.commands;
  findings.push_back(
      {"thrust_weight",
       fmt::format(
           "the rotors as stated lift {:.2g} times the weight in the mean of these logs: the mass or "
           "kT{} in other units, {} not what they are said to be, or the vehicle stood on the ground{}",
           ratio, commands ? " or km is" : " is", commands ? "the commands are" : "the speeds are",
           commands ? "" : unit_of_speeds(ratio))});
}

/// Rows in flight of which a command stands at its limit.
double saturated_share(const FlightRecord& record, std::span<const FlightLog> logs) {
  double rows = 0, limited = 0;
  for (const FlightArc& arc : record.arcs) {
    const FlightLog& log = logs[static_cast<std::size_t>(arc.log)];
    for (std::size_t i = 0; i < log.rows(); ++i) {
      if (log.t[i] < arc.t.front() || log.t[i] > arc.t.back()) continue;
      rows += 1;
      limited += std::ranges::any_of(log.delta, [&](const std::vector<double>& column) {
        return column[i] >= 0.999 || column[i] <= 0.001;
      });
    }
  }
  return rows > 0 ? limited / rows : 0.0;
}

/// The usual step between commands as logged, where the same few values come again and again; else 0.
double step_of_commands(const FlightLog& log) {
  constexpr std::size_t kFewest = 3, kAgain = 20;  // steps, and samples for each
  std::vector<double> values, steps;
  for (const std::vector<double>& column : log.delta)
    std::ranges::copy_if(column, std::back_inserter(values), [](double x) { return std::isfinite(x); });
  std::ranges::sort(values);
  for (std::size_t i = 1; i < values.size(); ++i)
    if (const double step = values[i] - values[i - 1]; step > 1e-6) steps.push_back(step);
  if (steps.size() < kFewest || values.size() < kAgain * steps.size()) return 0.0;
  return median(steps);
}

void test_commands(std::span<const FlightLog> logs, std::vector<Warning>& findings) {
  constexpr double kCoarse = 0.005;
  double step = 0;
  for (const FlightLog& log : logs) step = std::max(step, step_of_commands(log));
  if (step < kCoarse) return;
  findings.push_back(
      {"coarse_commands", fmt::format("Commands were logged in steps of {:.2g} % of their range. If the "
                                      "motors got finer ones, their lag is wrong by more than its interval, "
                                      "so it does not count as known. Log commands as they are sent.",
                                      100 * step)});
}

void test_health(const FlightRecord& record, std::span<const FlightLog> logs,
                 std::vector<Warning>& findings) {
  if (const double share = saturated_share(record, logs); share > kSaturatedShare)
    findings.push_back(
        {"saturated_commands",
         fmt::format("A command stands at its limit in {:.0f} % of the rows. The motors may get less there "
                     "than was logged, which biases thrust and motor constants. Fly more gently, or lighter.",
                     100 * share)});
  if (record.duration < kShortest)
    findings.push_back(
        {"short_log",
         fmt::format("The flight lasts {:.1f} s, which is too short for narrow intervals. Fly 40 s or more.",
                     record.duration)});
  if (record.interval > kSlowest)
    findings.push_back(
        {"low_rate", fmt::format("Rows come at {:.3g} Hz. Motor lag and fast turns pass between them, so "
                                 "motor constants are not identifiable. Log at 100 Hz or more.",
                                 1 / record.interval)});
  if (const auto seldom = seldom_input(record, logs)) findings.push_back(*seldom);
}

}  // namespace

std::vector<Warning> self_test(const FlightRecord& record, std::span<const FlightLog> logs,
                               const Vehicle& vehicle, std::span<const double> p) {
  SensorFrames frames;
  RotorTest rotors_by;
  in_parallel(2, [&](std::size_t part) {
    if (part == 0)
      frames = test_sensor_frames(record, vehicle.g);
    else
      rotors_by = test_rotors(record, vehicle, p);
  });
  std::vector<Warning> findings = frames.findings;
  // Rotors are judged by the rates: only where those are not in doubt already.
  if (findings.empty()) {
    const RotorAgreement rotors = rotors_by(frames.rates_confirmed);
    findings = rotors.findings;
    if (findings.empty()) test_excitation(rotors, findings);
  }
  test_weight(record, vehicle.g, p, findings);
  test_health(record, logs, findings);
  test_commands(logs, findings);
  return findings;
}

std::string disqualified(const std::vector<Warning>& warnings) {
  for (const Warning& w : warnings)
    for (const char* code : {"wrong_frame", "sign_flipped", "axes_swapped", "motor_order", "rotor_spin",
                             "thrust_weight", "logs_disagree"})
      if (w.code == code)
        return w.code + ": " + w.message + ". Until that is put right no number of this log can be trusted.";
  return {};
}

void distrust(Result& result, const std::string& wrong) {
  for (Parameter& parameter : result.parameters) {
    parameter.doubt({});
    parameter.note = wrong;
  }
  result.verdict = wrong;
}

}  // namespace ident
