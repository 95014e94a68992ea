// Two fits that differ in the commands only. With residuals r of the one that holds and r + d of the other,
// all in units of their noise, costs differ by d'd + 2 r'd, and the last term is chance of a standard
// deviation of 2 |d|: +d'd if commands held, -d'd if they went along lines, and anything else if they did
// neither.
//
// Of flights with controllers at 400 to 2000 Hz and logs at 50 to 500 Hz the difference was -1.6 to 0.2 or 3
// to 20 of d'd; where the log had all commands, 0.9 to 1.1, and in strong gusts, which a controller answers
// by the next command, up to 3, where d'd is below 60.
#include "ident/flight/checks/intersample_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/flight/checks/command_rate.h"
#include "ident/flight/checks/implausible_estimates.h"
#include "ident/flight/fit/fit_steps.h"
#include "ident/flight/fit/loop_timing.h"
#include "ident/flight/record/command_history.h"

namespace ident {
namespace {

// Less than expected, or more: standard deviations, and of what is expected; of more than little.
constexpr double kBeyondChance = 3.0, kGoodPart = 0.3;
constexpr double kFarBeyondChance = 4.0, kMuchMore = 1.5, kLittle = 150.0;
// What confirms them: as much expected, and so near to that.
constexpr double kTold = 400.0, kNearIt = 0.1;
constexpr double kMatters = 0.02;            // of the motors' lag
constexpr double kSmooth = 0.18;             // roughness() of commands whose steps do not show
constexpr double kSlowCommands = 1.0 / 110;  // s, where moments of inertia came out 3 to 10 % off
constexpr double kHistory = 1.0;             // s of commands before an arc
constexpr int kSteps = 4, kMostSteps = 10;

using Eigen::VectorXd;

bool are_smooth(std::span<const FlightLog> logs) {
  return std::ranges::all_of(logs, [](const FlightLog& log) { return !(roughness(log) > kSmooth); });
}

// To the motors: of 1 kHz logs it does not.
bool half_a_row_matters(const FlightRecord& record, std::span<const FlightLog> logs,
                        std::span<const double> p) {
  return input_interval(record, logs) / 2 > kMatters * 2 * p[param::zeta_m] / p[param::omega_m];
}

FlightRecord along_lines(FlightRecord record, std::span<const FlightLog> logs) {
  for (FlightArc& arc : record.arcs) {
    FlightInputs inputs = *arc.inputs;
    inputs.jumps.clear();
    inputs.delta = commands_along_lines(logs[static_cast<std::size_t>(arc.log)], arc.t.front() - kHistory,
                                        arc.t.back(), kSteps);
    arc.inputs = std::make_shared<const FlightInputs>(std::move(inputs));
  }
  return record;
}

// The constants of a fit, from there on, with a dead time of which nothing is known beforehand.
Theta with_free_dead_time(const FlightRecord& record, const Theta& theta, const FlightFit& fit) {
  const std::vector<double> p = theta.p(fit.u);
  std::vector<FreeConstant> constants;
  std::ranges::copy_if(theta.constants(), std::back_inserter(constants),
                       [](const FreeConstant& c) { return !c.watched && c.index != param::dead_time; });
  for (FreeConstant& c : constants) c.start = p[static_cast<std::size_t>(c.index)];
  for (FreeConstant& c : free_constants(*record.vehicle, p, {"dead_time"}))
    if (c.index == param::dead_time) c.prior_std.reset(), c.known_with.clear(), constants.push_back(c);
  return {p, std::move(constants), record.logs, record.signals.rates};
}

struct Explained {
  double cost = 0.0;
  FlightSmoother::Along at;
};

Explained explained(const FlightRecord& record, const Theta& theta, const FlightFit& fit) {
  FlightSmoother smoother(record, theta, fit.noise, fit.chunk_seconds);
  smoother.set_huber(fit.smoother->huber());
  smoother.start_from(*fit.smoother);
  VectorXd u = VectorXd::Zero(theta.size());
  const auto biases = u.size() - theta.constants_count();
  u.tail(biases) = fit.u.tail(biases);
  smoother.settle(u);
  u = minimise_shared(smoother, u, 0.5, kMostSteps).u;
  smoother.settle(u, 3, 1e-9);
  const double cost = linearize_at(smoother, u).cost + theta.prior(u).cost();
  smoother.accept();
  return {cost, smoother.along(VectorXd::Zero(u.size()))};
}

double square_between(const FlightSmoother::Along& a, const FlightSmoother::Along& b) {
  double square = 0;
  for (std::size_t k = 0; k < a.residuals.size(); ++k) {
    for (std::size_t i = 0; i < a.residuals[k].size(); ++i)
      if (const double d = b.residuals[k][i] - a.residuals[k][i]; std::isfinite(d)) square += d * d;
    if (a.defects[k].size() > 0) square += a.weights[k].dot((b.defects[k] - a.defects[k]).cwiseAbs2());
  }
  return square;
}

}  // namespace

bool HeldCommands::refuted() const {
  if (skipped) return true;
  const double less = expected - better, chance = 2 * std::sqrt(expected);
  return less > std::max(kGoodPart * expected, kBeyondChance * chance) ||
         -less > std::max((expected < kLittle ? kMuchMore : kGoodPart) * expected, kFarBeyondChance * chance);
}

bool HeldCommands::confirmed() const {
  return expected > kTold && std::abs(better - expected) < kNearIt * expected;
}

bool skip_what_matters(const FlightRecord& record, std::span<const FlightLog> logs,
                       std::span<const double> p) {
  return record.signals.commands && commands_are_skipped(logs) && half_a_row_matters(record, logs, p);
}

HeldCommands commands_held(const FlightRecord& record, std::span<const FlightLog> logs, const Theta& theta,
                           const FlightFit& fit) {
  if (loop_of(logs) > 0) return {};
  if (!record.signals.commands || !half_a_row_matters(record, logs, theta.p(fit.u))) return {};
  if (commands_are_skipped(logs)) return {.skipped = true};
  HeldCommands out{.rare = std::ranges::any_of(logs, commands_are_rarer_than_rates)};
  if (!out.rare && are_smooth(logs)) return out;
  const Theta own = with_free_dead_time(record, theta, fit);
  try {
    const Explained held = explained(record, own, fit),
                    lines = explained(along_lines(record, logs), own, fit);
    out.better = lines.cost - held.cost, out.expected = square_between(held.at, lines.at);
  } catch (const DataError&) {  // nothing flies so
  }
  return out;
}

void doubt_commands_between_rows(Result& result, const FlightRecord& record, std::span<const FlightLog> logs,
                                 const HeldCommands& held) {
  // Commands of which some are missing are noisy ones: the slope over them falls, and an offset appears.
  if (commands_are_skipped(logs) && result.has_warning("command_offset"))
    doubt_all(result, {"km", "Omega_0"}, "the log skips commands, which makes such an offset");
  if (!held.doubtful()) return;
  const char* const kWhy = held.refuted() ? "commands went on between those that were logged"
                                          : "commands may have gone on between those that were logged";
  doubt_all(result, {"omega_m", "zeta_m", "dead_time", "Jp"}, kWhy);
  const bool inertia = input_interval(record, logs) > kSlowCommands;
  if (inertia)  // and kQ, of which yaw tells the ratio to Jzz
    doubt_all(result, {"Jxx", "Jyy", "Jzz", "Jxy", "Jxz", "Jyz", "kQ"}, kWhy);
  if (result.has_warning("command_offset")) doubt_all(result, {"km", "Omega_0", "kT", "kQ"}, kWhy);
  result.warn(
      "commands_between_rows",
      fmt::format("{}. Motor constants{} are not identifiable. Log each command that is sent.",
                  held.skipped ? "As the log states, its controller goes on between the commands that "
                                 "were logged"
                  : held.refuted()
                      ? "The flight contradicts commands that hold from row to row: the controller "
                        "goes on in between, or the times of the rows are not those of the commands"
                      : "Commands were logged at a lower rate than the body rates, and the flight "
                        "does not show that they held in between",
                  inertia ? ", moments of inertia and kQ" : ""));
}

}  // namespace ident
