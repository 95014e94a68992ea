// Fits the DC motor by two linear fits, for each reading of the current column.
#include "ident/bench/thrust/dc_motor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ident/lsq/least_squares_fit.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

constexpr std::size_t kFewestRows = 5;
constexpr double kClear = 10.0;  // difference of -2 log likelihood that decides

struct Line {
  std::vector<double> a, b, y;  // y = p a + q b
};

bool any(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double v) { return std::isfinite(v); });
}

double motor_current(const MotorRows& rows, std::size_t i, CurrentSide side) {
  return side == CurrentSide::motor ? rows.current[i] : rows.current[i] / rows.delta[i];
}

Line voltage_line(const MotorRows& rows, CurrentSide side) {
  Line line;
  for (std::size_t i = 0; i < rows.Omega.size(); ++i) {
    const double I = motor_current(rows, i, side), V = rows.delta[i] * rows.voltage[i];
    if (!std::isfinite(I + V + rows.Omega[i]) || !(rows.delta[i] > 0.0)) continue;
    line.a.push_back(I), line.b.push_back(rows.Omega[i]), line.y.push_back(V);
  }
  return line;
}

Line torque_line(const MotorRows& rows, CurrentSide side) {
  Line line;
  if (rows.torque.empty()) return line;
  for (std::size_t i = 0; i < rows.Omega.size(); ++i) {
    const double I = motor_current(rows, i, side);
    if (!std::isfinite(I + rows.torque[i]) || !(rows.delta[i] > 0.0)) continue;
    line.a.push_back(I), line.b.push_back(-1.0), line.y.push_back(rows.torque[i]);
  }
  return line;
}

LeastSquaresFit fit(const Line& line, const char* first, const char* second, bool in_time_order) {
  const auto n = static_cast<Eigen::Index>(line.y.size());
  Eigen::MatrixXd A(n, 2);
  A.col(0) = Eigen::Map<const Eigen::VectorXd>(line.a.data(), n);
  A.col(1) = Eigen::Map<const Eigen::VectorXd>(line.b.data(), n);
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(line.y.data(), n);
  LeastSquaresProblem problem;
  problem.unknowns = {{first, 0.0}, {second, 0.0}};
  problem.residuals = n;
  problem.evaluate = linear_residuals(A, y);
  problem.groups = {{.name = "motor", .in_time_order = in_time_order}};
  return solve_least_squares(problem);
}

Parameter unknown(const char* name, const char* unit, const std::string& why) {
  return {.name = name, .unit = unit, .identifiable = false, .source = "thrust", .note = why};
}

/// A constant that came out with the wrong sign is not one: the duty is not the motor's.
Parameter checked(Parameter p, const char* unit, const char* name) {
  p.name = name;
  p.unit = unit;
  if (p.value > 0.0) return p;
  return unknown(name, unit,
                 "comes out negative: the command is no duty of the motor's voltage, or the current "
                 "is of something else");
}

/// I0 = (ki I0)/ki with the covariance of both.
Parameter no_load_current(const LeastSquaresFit& torque) {
  const double ki = torque.value("ki"), product = torque.value("ki_I0");
  Eigen::VectorXd gradient(2);
  gradient << -product / (ki * ki), 1.0 / ki;
  Parameter p = derived_parameter(torque, "I0", product / ki, gradient, "A", "thrust");
  p.identifiable = std::isfinite(p.std) && p.std < 0.5 * std::fabs(p.value);
  return p;
}

struct Candidate {
  CurrentSide side;
  LeastSquaresFit volts;
  std::optional<LeastSquaresFit> torque;
  double minus_two_log_likelihood = 0.0;
};

Candidate candidate(const MotorRows& rows, CurrentSide side) {
  Candidate made{.side = side, .volts = fit(voltage_line(rows, side), "R", "kv", rows.in_time_order)};
  made.minus_two_log_likelihood = made.volts.minus_two_log_likelihood;
  const Line line = torque_line(rows, side);
  if (line.y.size() < kFewestRows) return made;
  made.torque = fit(line, "ki", "ki_I0", rows.in_time_order);
  made.minus_two_log_likelihood += made.torque->minus_two_log_likelihood;
  return made;
}

MotorConstants none(std::string missing) {
  MotorConstants found{.missing = std::move(missing)};
  for (const auto& [name, unit] : std::array{std::pair{"ki", "N m/A"}, std::pair{"kv", "V s/rad"},
                                             std::pair{"R", "Ohm"}, std::pair{"I0", "A"}})
    found.parameters.push_back(unknown(name, unit, found.missing));
  return found;
}

}  // namespace

std::optional<MotorConstants> motor_constants(const MotorRows& rows) {
  const bool has_voltage = any(rows.voltage), has_current = any(rows.current);
  if (!has_voltage && !has_current) return std::nullopt;
  if (!has_voltage) return none("the voltage is not logged");
  if (!has_current) return none("the current is not logged");
  if (!any(rows.delta))
    return none(
        "voltage and current of the battery's side alone do not tell what the motor sees: the duty "
        "(column delta) is missing");
  if (voltage_line(rows, CurrentSide::motor).y.size() < kFewestRows)
    return none("too few rows hold duty, voltage, current and speed at once");
  const Candidate motor = candidate(rows, CurrentSide::motor),
                  battery = candidate(rows, CurrentSide::battery);
  const double difference = battery.minus_two_log_likelihood - motor.minus_two_log_likelihood;
  const Candidate& best = difference < 0.0 ? battery : motor;
  MotorConstants found{.side = best.side, .side_is_clear = std::fabs(difference) > kClear};
  found.parameters = {checked(fitted_parameter(best.volts, "kv", "", "thrust"), "V s/rad", "kv"),
                      checked(fitted_parameter(best.volts, "R", "", "thrust"), "Ohm", "R")};
  if (!best.torque) {
    found.missing = "the shaft's torque is not logged in the same rows as the current";
    found.parameters.push_back(unknown("ki", "N m/A", found.missing));
    found.parameters.push_back(unknown("I0", "A", found.missing));
    return found;
  }
  found.parameters.push_back(checked(fitted_parameter(*best.torque, "ki", "", "thrust"), "N m/A", "ki"));
  found.parameters.push_back(no_load_current(*best.torque));
  return found;
}

}  // namespace ident
