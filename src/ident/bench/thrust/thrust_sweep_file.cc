// Analyses one sweep file, from its rows to the constants.
#include "ident/bench/thrust/thrust_sweep_file.h"

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"

namespace ident {
namespace {

/// Medians over the set-points of a log, whose sensors answer in different rows.
std::vector<double> set_point_medians(const SweepRows& rows, const std::vector<double>& values) {
  std::vector<std::vector<double>> lists(static_cast<std::size_t>(rows.set_points));
  if (!values.empty())
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows.set_point[i] >= 0 && std::isfinite(values[i]))
        lists[static_cast<std::size_t>(rows.set_point[i])].push_back(values[i]);
  std::vector<double> medians;
  for (const std::vector<double>& list : lists) medians.push_back(median(list));
  return medians;
}

std::vector<double> moving_rows(const SweepRows& rows, const std::vector<double>& values) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!rows.at_rest[i]) kept.push_back(values.empty() ? kNaN : values[i]);
  return kept;
}

MotorRows motor_rows(const SweepFile& file) {
  const SweepRows& rows = file.rows;
  std::vector<double> torque;
  if (file.has_torque()) {
    const double tare = file.fit.fit.value("torque_tare");
    for (const double v : rows.torque) torque.push_back((file.points.torque.reversed ? -v : v) - tare);
  }
  const bool averaged = file.points.averaged;
  const auto of = [&](const std::vector<double>& values) {
    return averaged ? set_point_medians(rows, values) : moving_rows(rows, values);
  };
  return {.delta = of(rows.delta),
          .voltage = of(rows.voltage),
          .current = of(rows.current),
          .Omega = of(rows.Omega),
          .torque = torque.empty() ? std::vector<double>() : of(torque),
          .in_time_order = !averaged};
}

}  // namespace

SweepFile analyse_sweep(const NumberTable& table, const ThrustOptions& options,
                        std::vector<Warning>& warnings) {
  SweepFile file{.rows = sweep_rows(table, options.command, warnings)};
  file.points = sweep_points(file.rows);
  file.fit = fit_sweep(file.points);
  file.linear = fit_sweep(file.points, ThrustLaw::with_linear_term);
  file.thrust_law = judge_law(file.points.thrust, file.fit.thrust, file.linear.thrust, file.linear.fit);
  if (file.has_torque())
    file.torque_law = judge_law(file.points.torque, file.fit.torque, file.linear.torque, file.linear.fit);
  file.curve = command_curve(file.rows);
  file.command_falls = file.curve && file.curve->falls;
  if (file.command_falls) file.curve.reset();
  file.motor = motor_constants(motor_rows(file));
  return file;
}

}  // namespace ident
