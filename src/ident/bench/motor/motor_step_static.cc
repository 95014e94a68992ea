// Straight line through plateaus or through a curved static characteristic.
#include "ident/bench/motor/motor_step_static.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_fit.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

/// Points of the static curve: every plateau whose level is known, or the polynomial at the commands given.
void add_points(StaticLine& line, const std::vector<StepRecord>& records, const MotorFit& motor) {
  if (motor.curve == StaticCurve::cubic) {
    std::set<double> commands;
    for (const StepRecord& record : records)
      for (const CommandEdge& edge : record.edges) commands.insert(edge.delta);
    for (const double d : commands) {
      line.delta.push_back(d);
      line.level.push_back(
          motor.fit.value("Omega_0") +
          d * (motor.fit.value("km") + d * (motor.fit.value("k2") + d * motor.fit.value("k3"))));
    }
    return;
  }
  std::vector<double> std, delta, level;
  for (const StepRecord& record : records)
    for (const CommandEdge& edge : record.edges) {
      const std::string name = "level_" + std::to_string(delta.size());
      delta.push_back(edge.delta);
      level.push_back(motor.fit.value(name));
      std.push_back(motor.fit.std(name));
    }
  const double usual = median(std);
  for (std::size_t i = 0; i < delta.size(); ++i) {
    if (!(std[i] < 10.0 * usual)) continue;  // too short to settle
    line.delta.push_back(delta[i]);
    line.level.push_back(level[i]);
  }
}

LeastSquaresFit line_through(const StaticLine& line, Eigen::Index unknowns) {
  const auto n = static_cast<Eigen::Index>(line.delta.size());
  Eigen::MatrixXd A(n, unknowns);
  for (Eigen::Index i = 0; i < n; ++i) {
    A(i, 0) = line.delta[static_cast<std::size_t>(i)];
    if (unknowns > 1) A(i, 1) = 1.0;
  }
  LeastSquaresProblem problem{.residuals = n};
  problem.unknowns = {{"km", 0.0}};
  if (unknowns > 1) problem.unknowns.push_back({"Omega_0", 0.0});
  problem.evaluate = linear_residuals(A, Eigen::Map<const Eigen::VectorXd>(line.level.data(), n));
  return solve_least_squares(problem, {.robust = false, .max_colour_order = 0, .search_widely = false});
}

}  // namespace

StaticLine static_line(const std::vector<StepRecord>& records, const MotorFit& motor) {
  StaticLine line;
  std::vector<std::string> names = {"omega_m", "zeta_m", "dead_time"};
  if (motor.curve == StaticCurve::proportional || motor.curve == StaticCurve::line) {
    line.km = fitted_parameter(motor.fit, "km", "rad/s", "motor");
    if (motor.curve == StaticCurve::line)
      line.Omega_0 = fitted_parameter(motor.fit, "Omega_0", "rad/s", "motor");
    names.emplace_back("km");
    if (line.Omega_0) names.emplace_back("Omega_0");
    line.correlation = fitted_correlation(motor.fit, names);
    return line;
  }
  add_points(line, records, motor);
  const LeastSquaresFit through_zero = line_through(line, 1), free = line_through(line, 2);
  const LeastSquaresFit& best = free.bic < through_zero.bic ? free : through_zero;
  line.km = fitted_parameter(best, "km", "rad/s", "motor");
  line.km.note = "slope of the straight line through a static curve that is not straight";
  line.correlation = fitted_correlation(motor.fit, names);
  if (best.x.size() > 1) {
    line.Omega_0 = fitted_parameter(best, "Omega_0", "rad/s", "motor");
    line.correlation = line.correlation.beside(fitted_correlation(best, {"km", "Omega_0"}));
  }
  line.misfit = root_mean_square({best.residuals.data(), static_cast<std::size_t>(best.residuals.size())});
  return line;
}

}  // namespace ident
