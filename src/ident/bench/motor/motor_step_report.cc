// Fit over data, step response, static curve, residuals.
#include "ident/bench/motor/motor_step_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ident/core/format_number.h"
#include "ident/plots/residual_plots.h"
#include "ident/plots/spectrum_plot.h"

namespace ident {
namespace {

using Style = Series::Style;

Plot time_plot(const StepRecord& record, std::size_t number, const double* predicted) {
  const std::vector<double> model(predicted, predicted + record.rows());
  std::vector<double> command_t, command;
  const std::string name = std::filesystem::path(record.file).filename().string();
  return {.id = fmt::format("motor-fit-{}", number),
          .title = "Rotor speed, " + name,
          .x_label = "time [s]",
          .y_label = "Omega [rad/s]",
          .kind = Plot::Kind::time_series,
          .series = {{.name = "Omega measured", .x = record.t, .y = record.Omega, .style = Style::measured},
                     {.name = "Omega predicted", .x = record.t, .y = model, .style = Style::predicted}}};
}

Plot response_plot(const StepResponse& response) {
  Series band{.name = "95 % band", .x = response.t, .style = Style::band};
  for (std::size_t i = 0; i < response.t.size(); ++i) {
    band.y.push_back(response.value[i] - 1.96 * response.std[i]);
    band.y2.push_back(response.value[i] + 1.96 * response.std[i]);
  }
  return {
      .id = "motor-step-response",
      .title = "Answer to a unit step of the command",
      .caption = "Known with this band even where omega_m, zeta_m and dead_time are not known one by one.",
      .x_label = "time since the step [s]",
      .y_label = "share of the way to the new speed [-]",
      .series = {std::move(band),
                 {.name = "step response", .x = response.t, .y = response.value, .style = Style::line}}};
}

Plot static_plot(const StaticLine& line) {
  Series straight{.name = "straight line", .style = Style::line};
  for (const double d : {0.0, 1.0}) {
    straight.x.push_back(d);
    straight.y.push_back(line.km.value * d + (line.Omega_0 ? line.Omega_0->value : 0.0));
  }
  return {.id = "motor-static",
          .title = "Steady speed over command",
          .x_label = "command [-]",
          .y_label = "Omega [rad/s]",
          .series = {{.name = "plateaus", .x = line.delta, .y = line.level, .style = Style::points},
                     std::move(straight)}};
}

/// Measured minus predicted of all records, the rows in their order.
struct Residuals {
  std::vector<double> t, Omega, residual;
};

Residuals residuals(const std::vector<StepRecord>& records, const MotorFit& motor) {
  Residuals all;
  for (const StepRecord& record : records)
    for (std::size_t i = 0; i < record.rows(); ++i) {
      all.t.push_back(record.t[i]);
      all.Omega.push_back(motor.predicted[all.residual.size()]);
      all.residual.push_back(record.Omega[i] - motor.predicted[all.residual.size()]);
    }
  return all;
}

/// Median of the time from row to row, s.
double usual_step(const std::vector<double>& t) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  if (steps.empty()) return kNaN;
  std::ranges::nth_element(steps, steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2));
  return steps[steps.size() / 2];
}

Table times_table(const StepResponse& response) {
  Table table{.title = "Times of the step response", .columns = {"time", "value [s]", "95 % interval"}};
  for (const Parameter* p :
       {&response.rise_time, &response.time_constant, &response.lag, &response.total_lag})
    table.rows.push_back(
        {p->name, format_with_uncertainty(p->value, p->std), format_interval(p->ci95, p->value, p->std)});
  return table;
}

}  // namespace

std::vector<Section> motor_sections(const std::vector<StepRecord>& records, const MotorFit& motor,
                                    const StepResponse& response, const StaticLine& line) {
  Section fit{
      .title = "Motor steps",
      .text =
          "Omega'' + 2 zeta_m omega_m Omega' + omega_m^2 Omega = omega_m^2 (Omega_0 + km delta(t - "
          "dead_time)), "
          "solved exactly on the logged command; speed and rate at the start of a recording are free."};
  std::size_t row = 0;
  for (std::size_t k = 0; k < records.size(); ++k) {
    fit.plots.push_back(time_plot(records[k], k + 1, motor.predicted.data() + row));
    row += records[k].rows();
  }
  Section answer{
      .title = "Step response",
      .text =
          "rise_time: 10 to 90 %; time_constant: end of the dead time to 63 %; lag: 2 zeta_m/omega_m; "
          "total_lag: with the dead time.",
      .tables = {times_table(response)},
      .plots = {response_plot(response)}};
  if (!line.delta.empty()) answer.plots.push_back(static_plot(line));

  const Residuals all = residuals(records, motor);
  const std::size_t n = all.t.size();
  const std::vector<bool> rejected(motor.fit.rejected.begin(),
                                   motor.fit.rejected.begin() + static_cast<std::ptrdiff_t>(n));
  const std::vector<double> standardized(motor.fit.standardized.begin(),
                                         motor.fit.standardized.begin() + static_cast<std::ptrdiff_t>(n));
  std::vector<double> kept = all.residual;
  for (std::size_t i = 0; i < n; ++i)
    if (rejected[i]) kept[i] = kNaN;
  const ResidualNames names{.id = "motor-residual", .channel = "Omega", .unit = "rad/s"};
  Section left{.title = "What the motor model leaves over",
               .plots = {residual_plot(names, all.t, "time [s]", all.residual, rejected),
                         residual_plot(names, all.Omega, "speed [rad/s]", all.residual, rejected),
                         histogram_plot(names, standardized), normal_quantile_plot(names, standardized),
                         autocorrelation_plot(names, kept, standardized),
                         spectrum_plot(names, kept, usual_step(records.front().t))}};
  return {std::move(fit), std::move(answer), std::move(left)};
}

}  // namespace ident
