// The choice of the static curve, and where the search for the motor's shape starts.
#include "ident/bench/motor/motor_step_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "ident/bench/motor/motor_step_edges.h"
#include "ident/bench/motor/motor_step_problem.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

constexpr double kEvident =
    12.0;  // less of BIC that a richer static curve has to earn: four standard deviations
constexpr std::size_t kMostPlateaus = 80, kFewestRowsOfAPlateau = 10;
constexpr double kFarOff = 4.0;   // standard deviations
constexpr double kAnyEdge = 0.1;  // s, scatter of single dead times before anything is known of them
constexpr int kRowsInARow = 4;    // outliers come one by one

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
  const MotorProblem problem(records, {.curve = curve});
  std::vector<std::pair<double, MotorShape>> tried;
  for (const double omega_m : {6.0, 15.0, 35.0, 90.0, 300.0, 1200.0})
    for (const double zeta_m : {0.5, 1.0, 1.8})
      for (const double dead_time : {0.0, 0.015, 0.04, 0.1}) {
        const MotorShape shape{omega_m, zeta_m, dead_time};
        tried.emplace_back(problem.start(shape).residuals.squaredNorm(), shape);
      }
  std::ranges::sort(tried, {}, [](const auto& t) { return t.first; });
  return {tried[0].second, tried[1].second, tried[2].second};
}

/// Does a simpler curve, with the shape that a richer one gave, miss by so much that a fit of it is not
/// needed?
bool is_far_off(const std::vector<StepRecord>& records, const MotorFreedom& freedom, const MotorFit& richer) {
  const Eigen::VectorXd r = MotorProblem(records, freedom).start(richer.shape, richer.shifts).residuals;
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

const LeastSquaresOptions kFull{.search_widely = false},
    kQuick{.max_colour_order = 0, .search_widely = false},  // noise taken as white
    kPlain{.robust = false, .max_colour_order = 0, .search_widely = false};

/// What fits of one set of records share.
struct Fitting {
  const std::vector<StepRecord>& records;
  MovingRows rows = {};           ///< empty without plateaus
  std::vector<bool> spikes = {};  ///< left out of plain fits

  MotorFit fitted(const MotorFreedom& freedom, const std::vector<MotorShape>& shapes,
                  const std::vector<double>& shifts, const LeastSquaresOptions& options) const {
    const std::vector<bool> none;
    const MotorProblem problem(records, freedom, options.robust ? none : spikes,
                               options.robust ? spikes : none);
    std::vector<Eigen::VectorXd> starts;
    for (const MotorShape& shape : shapes) starts.push_back(problem.start(shape, shifts).x);
    return problem.solve(starts, options);
  }

  /// Plain least squares, with the deviations of motor_step_misfit.h.
  MotorFit plain(const MotorFreedom& freedom, const std::vector<MotorShape>& shapes,
                 const std::vector<double>& shifts) const {
    MotorFit motor = fitted(freedom, shapes, shifts, kPlain);
    std::vector<double> residuals;
    for (const StepRecord& record : records)
      for (const double Omega : record.Omega) residuals.push_back(motor.predicted[residuals.size()] - Omega);
    motor.transients = transient_misfit(residuals, rows);
    if (motor.transients.share > 0.0) widen(motor, MotorProblem(records, freedom, spikes));
    return motor;
  }

  /// Robust, with noise of any colour, where transients obey the motor's equation to the noise; else plain.
  MotorFit best(const MotorFreedom& freedom, const std::vector<MotorShape>& shapes,
                const std::vector<double>& shifts) const {
    if (rows.step.empty()) return fitted(freedom, shapes, shifts, kFull);
    MotorFit motor = plain(freedom, shapes, shifts);
    if (motor.transients.share > 0.0) return motor;
    return fitted(freedom, {motor.shape}, motor.shifts, kFull);
  }

 private:
  void widen(MotorFit& motor, const MotorProblem& problem) const {  // (1)
    std::vector<double> moving;
    for (std::size_t i = 0; i < rows.step.size(); ++i)
      if (const double r = motor.fit.residuals(static_cast<Eigen::Index>(i));
          rows.step[i] > 0.0 && !spikes[i])
        moving.push_back(r);
    const std::vector<double> rho = autocorrelation(moving, 1);
    const double r = rho.size() > 1 ? std::clamp(rho[1], 0.0, 1.0) : 0.0;
    // At most all rows of one transient say the same.
    const double longest = static_cast<double>(moving.size()) / static_cast<double>(count_steps(records));
    motor.widening = std::clamp((1.0 + r) / std::max(1.0 - r, 1e-9), 1.0, std::max(1.0, longest));
    const double variance = motor.fit.noise[0].sigma * motor.fit.noise[0].sigma;
    const Eigen::MatrixXd H = motor.fit.determined_covariance / variance;
    const Eigen::MatrixXd added = motor.widening * H * problem.squares(motor.fit.x) * H;
    motor.fit.determined_covariance += added;
    for (Eigen::Index i = 0; i < added.rows(); ++i)
      for (Eigen::Index k = 0; k < added.cols(); ++k)
        if (std::isfinite(motor.fit.covariance(i, i)) && std::isfinite(motor.fit.covariance(k, k)))
          motor.fit.covariance(i, k) += added(i, k);
    motor.dead_time = fitted_parameter(motor.fit, "dead_time", "s", "motor");
  }
};

bool has_both_directions(const std::vector<StepRecord>& records) {
  bool up = false, down = false;
  for (const StepRecord& record : records)
    for (std::size_t e = 1; e < record.edges.size(); ++e) (record.edges[e].down ? down : up) = true;
  return up && down;
}

/// Standard deviation of the edges' own dead times beyond what noise makes of them; 0 where that is all.
double edge_scatter(const MotorFit& motor) {
  const auto steps = static_cast<Eigen::Index>(motor.shifts.size());
  const Eigen::Index first = motor.fit.index("shift_0");
  const double middle = mean(motor.shifts);
  double squares = 0.0, from_noise = 0.0, seen = 0.0;
  for (Eigen::Index e = 0; e < steps; ++e) {
    // What all have in common is the dead time's.
    Eigen::VectorXd own = Eigen::VectorXd::Zero(motor.fit.x.size());
    own.segment(first, steps).setConstant(-1.0 / static_cast<double>(steps));
    own(first + e) += 1.0;
    const double std = motor.fit.std_of(own), shift = motor.shifts[static_cast<std::size_t>(e)] - middle;
    if (!(std < 0.5 * kAnyEdge)) continue;  // a step in which nothing was seen
    squares += shift * shift, from_noise += std * std, seen += 1.0;
  }
  return seen > 1.0 && squares > 2.0 * from_noise ? std::sqrt((squares - from_noise) / (seen - 1.0)) : 0.0;
}

/// The fit with all that may be free, and whether edges have dead times of their own.
MotorFit richest_fit(const Fitting& fitting, MotorFreedom freedom, const std::vector<MotorShape>& shapes) {
  MotorFit common = fitting.best(freedom, shapes, {});
  if (fitting.rows.step.empty()) return common;
  MotorFreedom any = freedom;
  any.edge_scatter = kAnyEdge;
  std::vector<MotorShape> near = shapes;
  near.insert(near.begin(), common.shape);
  const MotorFit look = fitting.plain(any, near, {});
  freedom.edge_scatter = edge_scatter(look);
  if (freedom.edge_scatter == 0.0) return common;
  MotorFit apart = fitting.best(freedom, {look.shape}, look.shifts);
  return apart.fit.bic + kEvident * apart.widening < common.fit.bic ? apart : common;
}

/// The fit again with no dead time; how well it is known is taken from the fit in which it was free.
MotorFit without_dead_time(const Fitting& fitting, const MotorFit& free) {
  const MotorFreedom freedom{
      .curve = free.curve, .dead_time = DeadTime::zero, .edge_scatter = free.edge_scatter};
  const MotorShape shape{free.shape.omega_m, free.shape.zeta_m, 0.0};
  MotorFit motor = fitting.best(freedom, {shape}, free.shifts);
  motor.shape.dead_time = 0.0;
  motor.negative_dead_time = motor.dead_time = free.dead_time;
  motor.dead_time.value = 0.0;
  motor.dead_time.ci95 = {0.0, free.dead_time.ci95[1] - free.dead_time.value};
  return motor;
}

Fitting fitting_of(const std::vector<StepRecord>& records) {
  Fitting fitting{.records = records};
  if (!has_plateaus(records)) return fitting;
  fitting.rows = moving_rows(records);
  fitting.spikes = lone_spikes(records, fitting.rows.noise);
  return fitting;
}

}  // namespace

MotorFit fit_motor(const std::vector<StepRecord>& records, const std::optional<MotorShape>& near) {
  const std::vector<StaticCurve> curves = possible_curves(records);
  const Fitting fitting = fitting_of(records);
  MotorFreedom freedom{.curve = curves.back()};
  if (!fitting.rows.step.empty() && has_both_directions(records)) freedom.directions = SpinDirections::apart;
  MotorFit best = richest_fit(fitting, freedom, starting_shapes(records, curves.back(), near));
  freedom.edge_scatter = best.edge_scatter;
  const MotorShape shape = best.shape;
  const std::vector<double> shifts = best.shifts;
  for (std::size_t i = curves.size() - 1; i-- > 0;) {
    freedom.curve = curves[i];
    if (is_far_off(records, freedom, best)) continue;
    MotorFit simpler = fitting.best(freedom, {shape}, shifts);
    if (simpler.fit.bic <= best.fit.bic + kEvident * best.widening) best = std::move(simpler);
  }
  if (freedom.directions == SpinDirections::apart) {
    freedom.curve = best.curve;
    freedom.directions = SpinDirections::alike;
    MotorShape between = best.shape;  // up and down
    between.omega_m *= std::sqrt(between.down_ratio);
    between.down_ratio = 1.0;
    best = fitting.best(freedom, {between}, best.shifts);
  }
  return best.shape.dead_time < 0.0 ? without_dead_time(fitting, best) : best;
}

MotorFit guess_motor(const std::vector<StepRecord>& records, const std::optional<MotorShape>& near) {
  const StaticCurve curve = possible_curves(records).back();
  const Fitting fitting{.records = records};
  return fitting.fitted({.curve = curve}, starting_shapes(records, curve, near), {}, kQuick);
}

std::optional<MotorFit> fit_motor_directions(const std::vector<StepRecord>& records, const MotorFit& alike) {
  if (!has_both_directions(records)) return std::nullopt;
  const MotorFreedom freedom{.curve = alike.curve,
                             .directions = SpinDirections::apart,
                             .dead_time = alike.negative_dead_time ? DeadTime::zero : DeadTime::free,
                             .edge_scatter = alike.edge_scatter};
  return fitting_of(records).best(freedom, {alike.shape}, alike.shifts);
}

bool contradicts(const StepRecord& record, const MotorFit& motor) {
  const std::vector<StepRecord> alone = {record};
  const MotorProblem problem(alone, {.curve = StaticCurve::plateaus, .directions = SpinDirections::apart});
  for (const double down_ratio : {1.0, 0.8, 0.6, 0.4, 1.3, 1.7}) {
    MotorShape shape = motor.shape;
    shape.down_ratio = down_ratio;
    if (longest_run(problem.start(shape).residuals, motor.fit.noise[0].sigma) < kRowsInARow) return false;
  }
  return true;
}

}  // namespace ident
