// Result of `ident motor`.
#include "ident/bench/motor/motor_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/bench/motor/motor_step_findings.h"
#include "ident/bench/motor/motor_step_look.h"
#include "ident/bench/motor/motor_step_report.h"
#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLeastExplained = 0.5;  // r2
constexpr double kLongestDeadTime = 0.5,
                 kFastestMotor = 500.0;  // s, rad/s: beyond it the time's unit is wrong

std::vector<StepRecord> all_records(const std::vector<NumberTable>& tables, const MotorOptions& options,
                                    Result& result) {
  std::vector<StepRecord> records;
  for (const NumberTable& table : tables) {
    result.inputs.push_back(table.file);
    result.warnings.insert(result.warnings.end(), table.warnings.begin(), table.warnings.end());
    for (StepRecord& record : step_records(table, options.command, result.warnings))
      records.push_back(std::move(record));
  }
  return records;
}

void add_fit(Result& result, const std::vector<StepRecord>& records, const MotorFit& motor) {
  std::vector<double> kept, speed;
  std::size_t row = 0;
  for (const StepRecord& record : records)
    for (const double Omega : record.Omega) {
      if (!motor.fit.rejected[row]) {
        kept.push_back(Omega - motor.predicted[row]);
        speed.push_back(Omega);
      }
      ++row;
    }
  const NoiseEstimate& noise = motor.fit.noise[0];
  result.fit["samples"] = row;
  result.fit["rejected"] = row - kept.size();
  result.fit["r2"] = r_squared(speed, kept);
  result.fit["rmse"] = {{"omega", root_mean_square(kept)}};
  result.fit["rho"] = noise.rho;
  constexpr std::array names = {"proportional", "line", "cubic", "plateaus"};
  result.fit["static_curve"] = names[static_cast<std::size_t>(motor.curve)];
}

/// A model that explains little of the speed says nothing of the motor.
void expect_answer(const Result& result, const std::vector<StepRecord>& records) {
  const double r2 = result.fit["r2"].get<double>();
  if (r2 > kLeastExplained && result.find("km")->value > 0.0) return;
  throw DataError(fmt::format(
      "{}: the speed does not follow the command: the motor model explains {:.0f} % of its changes{}; are "
      "command "
      "and speed of one recording, in the right columns, and does the speed rise with the command?",
      records.front().file, 100.0 * std::max(r2, 0.0),
      result.find("km")->value > 0.0 ? "" : " with a gain below zero"));
}

Json as_json(const Parameter& p) {
  return {{"value", p.value}, {"std", p.std}, {"ci95", {p.ci95[0], p.ci95[1]}}, {"unit", p.unit}};
}

void add_response(Result& result, const StepResponse& response) {
  result.extra["step_response"] = {{"t", response.t}, {"value", response.value}, {"std", response.std}};
  for (const Parameter* p :
       {&response.rise_time, &response.time_constant, &response.lag, &response.total_lag})
    result.extra[p->name] = as_json(*p);
}

}  // namespace

Result estimate_motor(const std::vector<NumberTable>& tables, const MotorOptions& options) {
  Result result{.command = "motor"};
  const FirstLook look = look_at_records(all_records(tables, options, result), result.warnings);
  const std::vector<StepRecord>& records = look.records;
  const MotorFit motor = fit_motor(records, look.near);
  const StepResponse response = step_response(motor);
  const StaticLine line = static_line(records, motor);

  result.parameters.push_back(line.km);
  if (line.Omega_0) result.parameters.push_back(*line.Omega_0);
  result.parameters.push_back(fitted_parameter(motor.fit, "omega_m", "rad/s", "motor"));
  result.parameters.push_back(fitted_parameter(motor.fit, "zeta_m", "-", "motor"));
  result.parameters.push_back(motor.dead_time);
  add_fit(result, records, motor);
  expect_answer(result, records);
  add_response(result, response);
  result.correlation = line.correlation;
  judge_separability(result, response, motor);
  judge_dead_times(result, records, motor, response);
  judge_transients(result, motor);
  judge_static_curve(result, records, line);
  compare_directions(result, records, motor);
  const Parameter& dead_time = *result.find("dead_time");
  if (const auto& free = motor.negative_dead_time; free && free->ci95[1] < 0.0)
    result.warn("negative_dead_time",
                fmt::format("the speed answers before the command changes, by {} s: the recording writes the "
                            "command too late, or the two columns are not of the same time. The dead time is "
                            "taken as 0; add a constant to the time of one of them",
                            format_with_uncertainty(-free->value, free->std)));
  if (dead_time.ci95[0] > kLongestDeadTime)
    result.warn(
        "implausible_dead_time",
        fmt::format("a dead time of {:.2g} s is that of no motor: is the time in seconds, and are command "
                    "and speed of the same time?",
                    dead_time.value));
  if (const Parameter& omega_m = *result.find("omega_m");
      omega_m.identifiable && omega_m.value > kFastestMotor)
    result.warn("implausible_motor",
                fmt::format("omega_m = {:.0f} rad/s is faster than motors are: is the time in seconds?",
                            omega_m.value));
  result.sections = motor_sections(records, motor, response, line);
  return result;
}

}  // namespace ident
