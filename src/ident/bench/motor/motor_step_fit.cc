// The choice of the static curve, and where the search for the motor's shape starts.
#include "ident/bench/motor/motor_step_fit.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "ident/bench/motor/motor_step_problem.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kEvident =
    12.0;  // less of BIC that a richer static curve has to earn: four standard deviations
constexpr std::size_t kMostPlateaus = 80, kFewestRowsOfAPlateau = 10;
constexpr double kFarOff = 4.0;  // standard deviations
constexpr int kRowsInARow = 4;   // outliers come one by one

std::size_t count_levels(const std::vector<StepRecord>& records) {
  std::set<double> levels;
  for (const StepRecord& record : records)
    for (const CommandEdge& edge : record.edges) levels.insert(edge.delta);
  return levels.size();
}

bool has_plateaus(const std::vector<StepRecord>& records) {
  std::size_t edges = 0, rows = 0;
  for (const StepRecord& record : records) edges += record.edges.size(), rows += record.rows();
  return count_levels(records) >= 3 && edges <= kMostPlateaus && rows >= edges * kFewestRowsOfAPlateau;
}

/// From the simplest to the one that bends most; where that is wrong the shape would bend instead.
std::vector<StaticCurve> possible_curves(const std::vector<StepRecord>& records) {
  std::vector<StaticCurve> curves = {StaticCurve::proportional};
  const std::size_t levels = count_levels(records);
  if (levels > 1) curves.push_back(StaticCurve::line);
  if (has_plateaus(records))
    curves.push_back(StaticCurve::plateaus);
  else if (levels >= 5)
    curves.push_back(StaticCurve::cubic);
  return curves;
}

/// The most promising shapes of a coarse grid, best first.
std::vector<MotorShape> promising_shapes(const std::vector<StepRecord>& records, StaticCurve curve) {
  const MotorProblem problem(records, curve, SpinDirections::alike);
  std::vector<std::pair<double, MotorShape>> tried;
  for (const double omega_m : {6.0, 15.0, 35.0, 90.0, 300.0, 1200.0})
    for (const double zeta_m : {0.5, 1.0, 1.8})
      for (const double dead_time : {0.0, 0.015, 0.04}) {
        const MotorShape shape{omega_m, zeta_m, dead_time};
        tried.emplace_back(problem.start(shape).residuals.squaredNorm(), shape);
      }
  std::ranges::sort(tried, {}, [](const auto& t) { return t.first; });
  return {tried[0].second, tried[1].second, tried[2].second};
}

/// Does a simpler curve, with the shape that a richer one gave, miss by so much that a fit of it is not
/// needed?
bool is_far_off(const std::vector<StepRecord>& records, StaticCurve curve, const MotorFit& richer) {
  const Eigen::VectorXd r = MotorProblem(records, curve, SpinDirections::alike).start(richer.shape).residuals;
  return mad_scale({r.data(), static_cast<std::size_t>(r.size())}) > kFarOff * richer.fit.noise[0].sigma;
}

/// Longest run of residuals on one side that noise does not explain.
int longest_run(const Eigen::VectorXd& residuals, double sigma) {
  int longest = 0, run = 0;
  double side = 0.0;
  for (const double r : residuals) {
    const bool far = std::fabs(r) > kFarOff * sigma;
    run = !far ? 0 : run > 0 && r * side > 0.0 ? run + 1 : 1;
    side = r;
    longest = std::max(longest, run);
  }
  return longest;
}

std::vector<MotorShape> starting_shapes(const std::vector<StepRecord>& records, StaticCurve curve,
                                        const std::optional<MotorShape>& near) {
  return near ? std::vector{*near} : promising_shapes(records, curve);
}

MotorFit fitted(const std::vector<StepRecord>& records, StaticCurve curve,
                const std::vector<MotorShape>& shapes,
                const LeastSquaresOptions& options = {.search_widely = false}) {
  const MotorProblem problem(records, curve, SpinDirections::alike);
  std::vector<Eigen::VectorXd> starts;
  for (const MotorShape& shape : shapes) starts.push_back(problem.start(shape).x);
  return problem.solve(starts, options);
}

/// The fit again with no dead time; how well it is known is taken from the fit in which it was free.
MotorFit without_dead_time(const std::vector<StepRecord>& records, const MotorFit& free) {
  const MotorProblem problem(records, free.curve, SpinDirections::alike, DeadTime::zero);
  MotorFit motor = problem.solve({problem.start({free.shape.omega_m, free.shape.zeta_m, 0.0}).x});
  motor.shape.dead_time = 0.0;
  motor.negative_dead_time = motor.dead_time = free.dead_time;
  motor.dead_time.value = 0.0;
  motor.dead_time.ci95 = {0.0, free.dead_time.ci95[1] - free.dead_time.value};
  return motor;
}

}  // namespace

MotorFit fit_motor(const std::vector<StepRecord>& records, const std::optional<MotorShape>& near) {
  const std::vector<StaticCurve> curves = possible_curves(records);
  MotorFit best = fitted(records, curves.back(), starting_shapes(records, curves.back(), near));
  const MotorShape shape = best.shape;
  for (std::size_t i = curves.size() - 1; i-- > 0;) {
    if (is_far_off(records, curves[i], best)) continue;
    MotorFit simpler = fitted(records, curves[i], {shape});
    if (simpler.fit.bic <= best.fit.bic + kEvident) best = std::move(simpler);
  }
  return best.shape.dead_time < 0.0 ? without_dead_time(records, best) : best;
}

MotorFit guess_motor(const std::vector<StepRecord>& records, const std::optional<MotorShape>& near) {
  const StaticCurve curve = possible_curves(records).back();
  return fitted(records, curve, starting_shapes(records, curve, near),
                {.max_colour_order = 0, .search_widely = false});
}

MotorFit fit_motor_directions(const std::vector<StepRecord>& records, const MotorFit& alike) {
  const MotorProblem problem(records, alike.curve, SpinDirections::apart,
                             alike.negative_dead_time ? DeadTime::zero : DeadTime::free);
  return problem.solve({problem.start(alike.shape).x});
}

bool contradicts(const StepRecord& record, const MotorFit& motor) {
  const std::vector<StepRecord> alone = {record};
  const MotorProblem problem(alone, StaticCurve::plateaus, SpinDirections::apart);
  for (const double down_ratio : {1.0, 0.8, 0.6, 0.4, 1.3, 1.7}) {
    MotorShape shape = motor.shape;
    shape.down_ratio = down_ratio;
    if (longest_run(problem.start(shape).residuals, motor.fit.noise[0].sigma) < kRowsInARow) return false;
  }
  return true;
}

}  // namespace ident
