// Equations, noise groups and outlier rules of the pendulum fit.
#include "ident/bench/inertia/trifilar_inertia_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_fit.h"

namespace ident {
namespace {

constexpr std::size_t kFewestRowsForOutliers = 10;  // of the file
constexpr std::size_t kFewestOfAnAxis = 3;          // of an axis: of two rows nobody can say which is wrong
constexpr std::array kAxes = {PendulumAxis::x, PendulumAxis::y, PendulumAxis::z, PendulumAxis::platform};

std::vector<double> column(const std::vector<PendulumRow>& rows, PendulumAxis axis,
                           double PendulumRow::*member) {
  std::vector<double> values;
  for (const PendulumRow& row : rows)
    if (row.axis == axis) values.push_back(row.*member);
  return values;
}

/// Bartlett's test: probability that groups of equal variance differ as much as these.
double equal_variance_probability(const std::vector<std::vector<double>>& groups) {
  double pooled = 0.0, dof = 0.0, logs = 0.0, inverse = 0.0;
  int used = 0;
  for (const std::vector<double>& g : groups) {
    if (g.size() < 3) continue;
    const double n = static_cast<double>(g.size()) - 1.0, s = standard_deviation(g);
    if (!(s > 0.0)) continue;
    pooled += n * s * s;
    dof += n;
    logs += n * std::log(s * s);
    inverse += 1.0 / n;
    ++used;
  }
  if (used < 2) return 1.0;
  const double statistic =
      (dof * std::log(pooled / dof) - logs) / (1.0 + (inverse - 1.0 / dof) / (3.0 * (used - 1)));
  return 1.0 - chi2_cdf(statistic, used - 1);
}

}  // namespace

PendulumModel::PendulumModel(std::vector<PendulumRow> rows, double gravity)
    : rows_(std::move(rows)), gravity_(gravity) {
  if (has_axis(PendulumAxis::platform))
    platform_mass_ = median(column(rows_, PendulumAxis::platform, &PendulumRow::mass));
  for (const PendulumRow& row : rows_) {
    if (row.axis != PendulumAxis::platform && row.mass <= platform_mass_)
      throw InputError(
          row.file, row.line, "mass",
          fmt::format("{} kg is not more than the empty platform's {} kg; it is the mass of all that "
                      "hangs on the wires, platform included",
                      row.mass, platform_mass_));
    if (!(suspension(row).radius_squared > 0.0))
      throw InputError(row.file, row.line, "offset", "puts the centre of gravity outside the wires");
  }
}

std::size_t PendulumModel::count(PendulumAxis axis) const {
  return static_cast<std::size_t>(std::ranges::count(rows_, axis, &PendulumRow::axis));
}

const char* PendulumModel::name(PendulumAxis axis) {
  constexpr std::array names = {"Jxx", "Jyy", "Jzz", "J_platform"};
  return names[static_cast<std::size_t>(axis)];
}

Eigen::Index PendulumModel::place(PendulumAxis axis) const {
  return std::ranges::count_if(kAxes, [&](PendulumAxis a) { return a < axis && has_axis(a); });
}

TrifilarSuspension PendulumModel::suspension(const PendulumRow& row) const {
  const double m = row.mass, d = row.axis == PendulumAxis::platform ? 0.0 : row.offset;
  const double c = (m - platform_mass_) * d / m;
  return {.mass = m,
          .gravity = gravity_,
          .radius_squared = row.radius * row.radius - c * c,
          .length = row.length,
          .amplitude = row.amplitude};
}

double PendulumModel::parallel_axis(const PendulumRow& row) const {
  if (row.axis == PendulumAxis::platform) return 0.0;
  return (row.mass - platform_mass_) * platform_mass_ / row.mass * row.offset * row.offset;
}

double PendulumModel::hanging_inertia(const PendulumRow& row, const Eigen::VectorXd& x) const {
  double J = x(place(row.axis)) + parallel_axis(row);  // (1)
  if (row.axis != PendulumAxis::platform && has_axis(PendulumAxis::platform))
    J += x(place(PendulumAxis::platform));
  return J;
}

double PendulumModel::linear_start(PendulumAxis axis) const {
  std::vector<double> J;
  for (const PendulumRow& row : rows_)
    if (row.axis == axis) J.push_back(trifilar_inertia(suspension(row), row.period) - parallel_axis(row));
  const bool on_platform = axis != PendulumAxis::platform && has_axis(PendulumAxis::platform);
  return median(J) - (on_platform ? linear_start(PendulumAxis::platform) : 0.0);
}

LeastSquaresProblem PendulumModel::problem(Grouping grouping, bool trust_stated) const {
  const auto n = static_cast<Eigen::Index>(rows_.size());
  LeastSquaresProblem problem{.residuals = n};
  // A row that states its deviation is divided by it; the others are compared as the times that were taken.
  Eigen::VectorXd weight(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PendulumRow& row = rows_[static_cast<std::size_t>(i)];
    weight(i) = row.std > 0.0 ? 1.0 / row.std : row.swings;
    const std::string group = row.std > 0.0                  ? "stated"
                              : grouping == Grouping::pooled ? "periods"
                                                             : std::string("periods ") + name(row.axis);
    auto at = std::ranges::find(problem.groups, group, &NoiseGroup::name);
    if (at == problem.groups.end()) {
      problem.groups.push_back({.name = group, .in_time_order = false});
      if (row.std > 0.0 && trust_stated) problem.groups.back().known_sigma = 1.0;
      at = problem.groups.end() - 1;
    }
    problem.series.push_back({.begin = i,
                              .end = i + 1,
                              .group = static_cast<int>(at - problem.groups.begin()),
                              .may_have_outliers = count(row.axis) >= kFewestOfAnAxis});
  }
  for (const PendulumAxis axis : kAxes)
    if (has_axis(axis)) problem.unknowns.push_back({name(axis), linear_start(axis)});
  problem.evaluate = [this, weight](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    for (Eigen::Index i = 0; i < r.size(); ++i) {
      const PendulumRow& row = rows_[static_cast<std::size_t>(i)];
      const double inertia = hanging_inertia(row, x);
      if (!(inertia > 0.0)) return false;
      const TrifilarPeriod T = trifilar_period(suspension(row), inertia);
      r(i) = weight(i) * (T.period - row.period);
      if (!J) continue;
      (*J)(i, place(row.axis)) = weight(i) * T.slope;
      if (has_axis(PendulumAxis::platform)) (*J)(i, place(PendulumAxis::platform)) = weight(i) * T.slope;
    }
    return true;
  };
  return problem;
}

LeastSquaresFit PendulumModel::fit(std::vector<Warning>& warnings) const {
  const LeastSquaresOptions options{.robust = rows_.size() >= kFewestRowsForOutliers};
  // First with free levels: they show whether stated deviations are right and whether the axes are alike.
  LeastSquaresFit free = solve_least_squares(problem(Grouping::pooled, false), options);
  std::vector<std::vector<double>> by_axis(kAxes.size());
  double squares = 0.0, stated = 0.0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double r = free.residuals(static_cast<Eigen::Index>(i));
    if (free.rejected[i]) continue;
    if (rows_[i].std > 0.0)
      squares += r * r, stated += 1.0;
    else
      by_axis[static_cast<std::size_t>(rows_[i].axis)].push_back(r);
  }
  const double dof = free.degrees_of_freedom;
  const bool scatter = stated > dof && dof > 0.0 && 1.0 - chi2_cdf(squares, dof) < 1e-3;
  if (scatter)
    warnings.push_back(
        {"period_scatter",
         fmt::format("the periods scatter {:.1f} times as much as their column `std` says; the "
                     "intervals follow the scatter",
                     std::sqrt(squares / dof))});
  const bool unequal = equal_variance_probability(by_axis) < 0.05;
  if (!unequal && (scatter || stated == 0.0)) return free;
  return solve_least_squares(problem(unequal ? Grouping::by_axis : Grouping::pooled, !scatter), options);
}

}  // namespace ident
