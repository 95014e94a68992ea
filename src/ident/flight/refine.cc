// Puts the refinement together: start, fit, identifiability, disagreement with the bench, validation.
#include "ident/flight/refine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/flight/checks/air_exceeds.h"
#include "ident/flight/checks/command_rate.h"
#include "ident/flight/checks/gust_dominance.h"
#include "ident/flight/checks/implausible_estimates.h"
#include "ident/flight/checks/intersample_commands.h"
#include "ident/flight/checks/log_self_test.h"
#include "ident/flight/checks/logs_consistent.h"
#include "ident/flight/checks/mean_moment.h"
#include "ident/flight/checks/mean_thrust.h"
#include "ident/flight/checks/rotor_speed_jitter.h"
#include "ident/flight/checks/unidentifiable.h"
#include "ident/flight/checks/vibration_in_commands.h"
#include "ident/flight/conditioning/battery_voltage.h"
#include "ident/flight/fit/extend_by_score_test.h"
#include "ident/flight/fit/first_order_motors.h"
#include "ident/flight/fit/fit_covariance.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/fit/held_out_validation.h"
#include "ident/flight/fit/hover_priors.h"
#include "ident/flight/fit/input_sensitivity.h"
#include "ident/flight/fit/loop_timing.h"
#include "ident/flight/fit/physical_inertia.h"
#include "ident/flight/ladder/ladder.h"
#include "ident/flight/prepare.h"
#include "ident/flight/record/channel_units.h"
#include "ident/flight/record/excerpts.h"
#include "ident/flight/refine_along_motion.h"
#include "ident/flight/refine_trim.h"
#include "ident/views/chosen_rung.h"
#include "ident/views/data_health.h"
#include "ident/views/flight_residuals.h"
#include "ident/views/held_out_section.h"
#include "ident/views/profile_likelihood.h"
#include "ident/views/thrust_by_command.h"

namespace ident {
namespace {

using Eigen::VectorXd;

constexpr std::size_t kProfiles = 3;  // of weak constants; more take longer than the fit

// What a filter made late passes for lag of the motors where nothing else tells.
bool filter_lag_is_open(const Result& result, const Signals& logged) {
  return !logged.attitude && logged.commands && result.has_warning("filtered_noise");
}

nlohmann::ordered_json process_json(const std::array<ColouredNoise, 3>& noise) {
  nlohmann::ordered_json std = nlohmann::ordered_json::array(), time = std;
  for (const ColouredNoise& axis : noise) std.push_back(axis.sigma), time.push_back(axis.tau);
  return {{"std", std}, {"correlation_time", time}};
}

// The `fit` of a result: how it was fitted, and the noise that was found.
nlohmann::ordered_json as_json(const FlightRecord& record, const FlightFit& fit) {
  nlohmann::ordered_json j{
      {"seconds", record.duration}, {"steps", fit.steps}, {"segment_seconds", fit.chunk_seconds}};
  j["process_noise"] = nlohmann::ordered_json::array();  // of each log
  for (const AirNoise& air : fit.noise.air)
    j["process_noise"].push_back(
        {{"angular_acceleration", process_json(air.w_dot)}, {"acceleration", process_json(air.v_dot)}});
  j["axes_of_acceleration"] = fit.noise.axes == GustAxes::world ? "world" : "body";
  static constexpr std::array shown = {"attitude", "velocity", "position"};
  for (std::size_t g = 0; g < shown.size(); ++g)
    if (record.layout.shown_error[g] >= 0) j["slow_errors"][shown[g]] = process_json(fit.noise.slow[g]);
  nlohmann::ordered_json levels;
  for (int c = 0; c < kChannels; ++c)
    if (record.sigma[static_cast<std::size_t>(c)] != 1.0)
      levels[channel_name(c)] = fit.noise.sigma[static_cast<std::size_t>(c)];
  j["noise"] = levels;
  return j;
}

// What is known only together, a warning for each group that hangs together.
void warn_of_correlated(Result& result) {
  constexpr double kTogether = 0.95;
  const auto& [names, correlation] = result.correlation;
  const auto n = static_cast<Eigen::Index>(names.size());
  std::vector<bool> told(names.size(), false);
  for (Eigen::Index first = 0; first < n; ++first) {
    if (told[static_cast<std::size_t>(first)]) continue;
    std::vector<Eigen::Index> group{first};
    double most = 0;
    for (std::size_t at = 0; at < group.size(); ++at)
      for (Eigen::Index k = first + 1; k < n; ++k) {
        const double r = k == group[at] ? 0.0 : correlation(group[at], k);
        if (!(std::abs(r) > kTogether)) continue;
        if (std::abs(r) > std::abs(most)) most = r;
        if (std::ranges::find(group, k) == group.end()) group.push_back(k);
      }
    std::vector<std::string> members;
    for (const Eigen::Index k : group) {
      told[static_cast<std::size_t>(k)] = true;
      members.push_back(names[static_cast<std::size_t>(k)]);
    }
    if (members.size() == 2)
      result.warn("correlated", fmt::format("{} and {} are known only together (correlation {:.3f}). Use "
                                            "them together; a bench value of one fixes the other.",
                                            members[0], members[1], most));
    else if (members.size() > 2)
      result.warn("correlated", fmt::format("{} are known only together (correlations up to {:.3f} in size). "
                                            "Use them together; a bench value of one fixes the others.",
                                            fmt::join(members, ", "), std::abs(most)));
  }
}

// Constants that are asked for where the logs contradict a file that is silent about them.
std::vector<std::string> watched_constants(const Result& result, const Signals& logged) {
  std::vector<std::string> watched = {"Omega_0", "Jp"};
  if (!filter_lag_is_open(result, logged)) watched.emplace_back("dead_time");
  return watched;
}

// The same logs with measured speeds as the input, for rotors that jump as no command says.
Result refined_by_speeds(const Vehicle& vehicle, std::span<const FlightLog> logs,
                         const RefineOptions& options, const FeltJitter& jitter) {
  Result result = refine_as_logged(vehicle, without_commands(logs), options);
  std::erase_if(result.warnings, [](const Warning& w) { return w.code == "speeds_as_input"; });
  result.warnings.push_back(jitter.warning(
      "the speeds are the input, and the motors are not estimated. Look for unsteady motor control."));
  return result;
}

// The same with a damping that makes motors of first order, so that what is known of them can be stored.
Result refined_as_first_order(const Vehicle& vehicle, std::span<const FlightLog> logs,
                              const RefineOptions& options, const MotorLag& lag) {
  Result result = refine_as_logged(with_first_order_motors(vehicle, lag), logs, options);
  if (const auto zeta_m = std::ranges::find(result.parameters, "zeta_m", &Parameter::name);
      zeta_m != result.parameters.end()) {
    zeta_m->prior_value.reset(), zeta_m->prior_std.reset(), zeta_m->pull.reset();
    zeta_m->note = "held near 50: motors of first order";
  }
  result.warn("first_order_motors",
              fmt::format("Rotors follow their commands with a first-order lag of {} s (± {} s). Only that "
                          "lag, 2 zeta_m/omega_m, is known, and zeta_m is held near 50. A bench record of "
                          "steps tells the two apart.",
                          format_number(lag.seconds, 3), format_number(lag.std, 1)));
  return result;
}

// Whether what was fitted predicts other flight, beside the constants as stated. Frees the smoother of the
// fit, the largest thing in memory.
void validate(Result& result, const FlightRecord& record, const Theta& theta, FlightFit& fit, Shown shown,
              std::optional<LadderResult> ladder) {
  const FlightRecord held_out = held_out_of(record, kTrainingShare);
  FlightFit view = fit;
  view.u = fit_of_training(fit, record, theta, kTrainingShare);
  view.u = nearest_body(theta, view);
  VectorXd before = view.u;
  // The constants as stated, with the gyro biases of the fit.
  before.head(static_cast<Eigen::Index>(result.parameters.size())).setZero();
  fit.smoother.reset(), view.smoother.reset();
  const Validation validation = validate_refined(held_out, theta, before, view);
  result.fit["held_out"] = held_out_json(validation);
  result.sections.push_back(held_out_section(validation, held_out, theta, before, view, shown));
  if (validation.worse) doubt_where_worse(result, predicts_worse_text(validation));
  if (!ladder) return;
  judge_full(*ladder, record, {theta.p(view.u), theta.p(nearest_body(theta, fit))});
  settle_for_chosen(result, *ladder, *record.vehicle);
}

std::string verdict(const Result& result, double seconds) {
  const auto determined =
      std::ranges::count_if(result.parameters, [](const Parameter& p) { return p.identifiable; });
  return fmt::format("{} of {} parameters are determined by {:.0f} s of flight{}.", determined,
                     result.parameters.size(), seconds,
                     result.has_warning("predicts_worse")
                         ? ", but they predict other flight worse than those stated do"
                         : "");
}

void warn_of_filter_lag(Result& result, const Signals& logged) {
  if (!filter_lag_is_open(result, logged) || result.find("dead_time")) return;
  doubt_all(result, {"omega_m", "zeta_m"}, "goes with the delay of filters, which is unknown");
  result.warn(
      "filter_lag",
      "Rates and specific force were filtered, and without attitude the delay of the filter is unknown. It "
      "counts as lag of the motors, which comes out longer by it. Log attitude, or use '--free dead_time'.");
}

// What a fit refers to; `body` is the nearest with an inertia that a body can have.
struct Refined {
  const Vehicle& vehicle;
  std::span<const FlightLog> logs;
  const FlightRecord& record;
  const Theta& theta;
  const FlightFit &fit, &body;
  AirShare air;
  std::optional<AirBalance> pushed;
};

// Findings about the fit, and what does not count as known because of them.
void judge(Result& result, const Refined& refined, const SteadyPush& push, const Vibration& vibration,
           std::vector<Warning>& tested) {
  const auto& [vehicle, logs, record, theta, fit, body, air, pushed] = refined;
  for (const Warning& w : logs_agree(record, logs, theta, fit))
    result.warnings.push_back(w), tested.push_back(w);
  warn_of_steady_push(result, push, logs, vehicle.g);
  if (disqualified(tested).empty())
    warn_of_steady_turn(result, steady_turn(record, theta, fit), record, logs);
  if (vehicle.signs == Signs::first_principles) doubt_negative_rotor_inertia(result);
  doubt_contradicted(result);
  doubt_motors_without_effect(result);
  doubt_coarse_commands(result);
  if (!record.signals.commands) doubt_seldom_speeds(result);
  doubt_seldom_commands(result, record, logs);
  if (!seldom_input(record, logs))
    doubt_commands_between_rows(result, record, logs, commands_held(record, logs, theta, fit));
  warn_of_air(result, air);
  warn_of_excess(result, pushed);
  if (const auto battery = battery_not_modelled(vehicle, logs)) result.warnings.push_back(*battery);
  doubt_passed_on(result, vibration);
  warn_of_filter_lag(result, record.signals);
  warn_about(result, theta, fit);
  warn_of_inertia(result, theta, fit);
  warn_of_correlated(result);
}

// Numbers of the fit, tables and pictures.
void show(Result& result, const Refined& refined, const SteadyPush& push, const Vibration& vibration,
          Shown shown) {
  const auto& [vehicle, logs, record, theta, fit, body, air, pushed] = refined;
  result.fit = as_json(record, fit);
  result.fit["air_over_rotors"] = air.over_rotors;
  if (pushed) result.fit["air"] = as_json(*pushed);
  std::vector<ThrustAt> thrust;
  if (!push.matters(vehicle.g)) thrust = thrust_over_commands(record, logs, theta, body);
  if (!thrust.empty()) result.fit["thrust_by_command"] = as_json(thrust);
  if (shown != Shown::numbers) {
    result.sections.push_back(data_health(record, logs, fit.noise, vibration));
    if (!thrust.empty()) result.sections.push_back(thrust_section(thrust));
    result.sections.push_back(flight_residuals(record, fit));
    result.sections.push_back(outside_accelerations(record, fit));
  }
  if (shown == Shown::pictures)
    std::ranges::move(profile_sections(fit, theta, result.parameters, kProfiles),
                      std::back_inserter(result.sections));
}

}  // namespace

Result refine_as_logged(const Vehicle& vehicle, std::span<const FlightLog> logs,
                        const RefineOptions& options) {
  Result result;
  result.command = "flightlog";
  FlightEntry entry = enter_flight(vehicle, logs, result);
  auto& [p, record, tested, vibration] = entry;
  if (only_trim(record.signals)) {
    refine_trim(result, record, p, options.free);
    result.sections.push_back(data_health(record, logs, initial_noise(record), vibration));
    if (const std::string wrong = disqualified(tested); !wrong.empty()) distrust(result, wrong);
    return result;
  }
  require_turning(record.signals);
  std::optional<LadderResult> ladder = ladder_of(record, options);
  if (ladder && ends_along_motion(*ladder, entry, options))
    return refined_along_motion(std::move(result), vehicle, logs, entry, *ladder, options.shown);
  std::vector<FreeConstant> constants = free_constants(vehicle, p, options.free);
  if (!record.signals.commands)
    leave_out_motors(constants);
  else
    leave_loop_open(constants, vehicle, p, logs);
  const std::vector<FreeConstant> known = constants;
  std::vector<std::string> held;
  if (is_hover(tested)) held = hold_for_hover(constants);
  WatchOptions watch{.also = options.free, .progress = options.progress};
  if (held.empty()) watch.watched = watched_constants(result, record.signals);
  auto [free, fit] = fit_and_watch(vehicle, p, record, constants, watch, result);
  const Theta& theta = *free;
  if (const FeltJitter jitter = felt_jitter(record, theta, fit);
      jitter.matters() && may_do_without_commands(logs, options.free)) {
    fit.smoother.reset();
    return refined_by_speeds(vehicle, logs, options, jitter);
  }
  if (options.bootstrap > 0) fit.covariance = bootstrap_covariance(fit, theta, options.bootstrap);
  for (const VectorXd& moved :
       {moved_by_rougher_speeds(record, theta, fit), moved_by_time(record.turns_apart, theta, fit),
        moved_by_smoothing(logs, theta, fit), moved_by_time(loop_of(logs), theta, fit),
        moved_by_time(commands_are_skipped(logs) ? input_interval(record, logs) / 2 : 0.0, theta, fit)})
    fit.covariance += moved * moved.transpose();
  FlightFit body = fit;
  body.smoother.reset(), body.u = nearest_body(theta, fit);
  result.parameters = flight_parameters(theta, body, "flightlog");
  if (const auto lag = first_order_lag(vehicle, theta, fit, result.parameters)) {
    fit.smoother.reset();
    return refined_as_first_order(vehicle, logs, options, *lag);
  }
  as_before_flight(result.parameters, known, held);
  result.prior_correlation =
      vehicle.correlation.part([&](const std::string& name) { return result.find(name) != nullptr; });
  result.correlation = flight_correlation(theta, fit.u, fit.covariance);
  const Refined refined{
      vehicle, logs, record, theta, fit, body, air_share(record, fit), air_balance(record, fit)};
  const SteadyPush push = steady_push(record, fit);
  judge(result, refined, push, vibration, tested);
  show(result, refined, push, vibration, options.shown);
  if (options.validate && record.duration > kLeastJudged)
    validate(result, record, theta, fit, options.shown, std::move(ladder));
  result.verdict = verdict(result, record.duration);
  if (const std::string wrong = disqualified(tested); !wrong.empty()) distrust(result, wrong);
  return result;
}

}  // namespace ident
