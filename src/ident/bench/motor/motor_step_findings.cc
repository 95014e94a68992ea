// Findings of the motor fit, each with its numbers.
#include "ident/bench/motor/motor_step_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/bench/motor/motor_step_edges.h"
#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

constexpr double kWorthSaying = 0.005;  // smaller differences of omega_m up and down matter to nobody
constexpr double kDifferenceAt = 1e-3;  // probability below which spin-up and spin-down count as different

Parameter& parameter(Result& result, const std::string& name) {
  return *std::ranges::find(result.parameters, name, &Parameter::name);
}

/// Time from the end of the dead time to 63 % with edges down `ratio` times as fast.
nlohmann::ordered_json time_constant(const Parameter& p) {
  return {{"value", p.value}, {"std", p.std}, {"ci95", {p.ci95[0], p.ci95[1]}}, {"unit", "s"}};
}

}  // namespace

void judge_separability(Result& result, const StepResponse& response, const MotorFit& motor) {
  Parameter &omega_m = parameter(result, "omega_m"), &zeta_m = parameter(result, "zeta_m"),
            &dead_time = parameter(result, "dead_time");
  // A dead time of nothing is a finding too: it counts as known when it is known against the motor's lag.
  dead_time.identifiable =
      motor.edge_scatter > 0.0 ||  // judged by its scatter
      dead_time.std < 0.1 * std::max(std::fabs(dead_time.value), response.total_lag.value);
  if (omega_m.identifiable && zeta_m.identifiable && dead_time.identifiable) return;
  const Parameter& known = response.lag.identifiable ? response.lag : response.total_lag;
  const std::string words = response.lag.identifiable ? "2 zeta_m/omega_m" : "2 zeta_m/omega_m + dead_time";
  std::string names;
  for (Parameter* p : {&omega_m, &zeta_m, &dead_time}) {
    if (p->identifiable) continue;
    names += (names.empty() ? "" : ", ") + p->name;
    p->note = "cannot be told apart from the motor's other constants; " + words + " is known";
  }
  result.warn(
      "not_separable",
      fmt::format("{} cannot be told apart from these data (a lag of first order with a delay fits nearly as "
                  "well): known is {} = {} s, and the step response within its band. Faster sampling or "
                  "larger steps would separate them.",
                  names, words, format_with_uncertainty(known.value, known.std)));
}

void judge_dead_times(Result& result, const std::vector<StepRecord>& records, const MotorFit& motor,
                      const StepResponse& response) {
  const double answer_time = response.total_lag.value + motor.edge_scatter;
  const RecorderPauses pauses = recorder_pauses(records, answer_time);
  const std::size_t steps = count_steps(records);
  if (pauses.steps > 0)
    result.warn(
        "recorder_pauses",
        fmt::format("the recording has pauses of up to {:.3g} ms, beside {:.3g} ms from row to row, in the "
                    "motor's answer to {} of {} steps: what happened in them is not seen",
                    1e3 * pauses.longest, 1e3 * pauses.usual, pauses.steps, steps));
  if (motor.edge_scatter == 0.0) return;
  Parameter& dead_time = parameter(result, "dead_time");
  const auto [low, high] = std::ranges::minmax(motor.shifts);
  const double half_width =
      t_quantile(0.975, std::max(1.0, static_cast<double>(motor.shifts.size()) - 1.0)) * motor.edge_scatter;
  dead_time.std = motor.edge_scatter;
  dead_time.ci95 = {std::max(dead_time.value - half_width, 0.0), dead_time.value + half_width};
  dead_time.identifiable = dead_time.std < 0.1 * response.total_lag.value;
  dead_time.note = "not one for all steps: the deviation is that of a single step";
  result.warn(
      "dead_time_varies",
      fmt::format("the dead time is not the same for all steps: from {:.3g} to {:.3g} ms in {} steps. Each "
                  "has its own in the fit, so that this does not reach omega_m and zeta_m. A recorder that "
                  "stalls or writes the command before it is sent adds to it: the smallest is nearest to "
                  "the motor's own",
                  1e3 * (motor.shape.dead_time + low), 1e3 * (motor.shape.dead_time + high), steps));
}

void judge_transients(Result& result, const MotorFit& motor) {
  const double share = motor.transients.share;
  result.fit["transient_misfit"] = share;
  if (share < kWorthSaying) return;
  result.warn(
      "transient_misfit",
      fmt::format("on its way from level to level the speed misses the motor's equation by {:.2g} % of the "
                  "way that is left, settled rows by {:.2g} rad/s: deviations of omega_m and zeta_m are "
                  "widened accordingly",
                  100.0 * share, motor.transients.sigma));
}

void compare_directions(Result& result, const std::vector<StepRecord>& records, const MotorFit& motor) {
  const std::optional<MotorFit> apart = fit_motor_directions(records, motor);
  if (!apart) return;
  const LeastSquaresFit& fit = apart->fit;
  const Parameter ratio = fitted_parameter(fit, "down_ratio", "-", "motor");
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(fit.x.size(), fit.index("down_ratio"));
  const double t = std::log(ratio.value) * ratio.value / ratio.std;
  const double p = two_sided_p(t, fit.dof_of(unit));
  const Parameter up = step_response(*apart).time_constant;
  const double down = up.value / ratio.value;  // all times of the motor scale with 1/omega_m
  result.extra["spin"] = {{"ratio", ratio.value},
                          {"std", ratio.std},
                          {"ci95", {ratio.ci95[0], ratio.ci95[1]}},
                          {"probability_alike", p},
                          {"time_constant_up", time_constant(up)},
                          {"time_constant_down", {{"value", down}, {"unit", "s"}}}};
  if (!(p < kDifferenceAt) || std::fabs(std::log(ratio.value)) < kWorthSaying) return;
  result.warn(
      "spin_asymmetry",
      fmt::format(
          "spin-down and spin-up differ: omega_m down over omega_m up is {} (probability of so much by "
          "chance {:.2g}); time constant {:.1f} ms up, {:.1f} ms down. The constants above are those "
          "of both together.",
          format_with_uncertainty(ratio.value, ratio.std), p, 1e3 * up.value, 1e3 * down));
}

void judge_static_curve(Result& result, const std::vector<StepRecord>& records, const StaticLine& line) {
  if (line.delta.empty()) return;
  double full_scale = 0.0;
  for (const StepRecord& record : records)
    for (const double Omega : record.Omega) full_scale = std::max(full_scale, std::fabs(Omega));
  result.fit["static_misfit"] = line.misfit / full_scale;
  result.warn(
      "static_curve",
      fmt::format(
          "the steady speed is not a straight line of the command: it misses the plateaus by {:.1f} % "
          "of full scale. Plateaus have their own levels in the fit, so that this does not reach "
          "omega_m, zeta_m and dead_time.",
          100.0 * line.misfit / full_scale));
}

}  // namespace ident
