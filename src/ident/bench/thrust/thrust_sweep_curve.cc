// Straight line from command to speed, and whether it is bent.
#include "ident/bench/thrust/thrust_sweep_curve.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "ident/core/math.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_fit.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

constexpr double kBent = 1.0;  // % of full speed that the square takes away
constexpr std::size_t kMostRows = 3000;

struct Pairs {
  std::vector<double> delta, Omega;
};

/// Medians over the set-points.
Pairs set_point_pairs(const SweepRows& rows) {
  std::vector<std::vector<double>> delta(static_cast<std::size_t>(rows.set_points)), Omega(delta.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows.set_point[i] < 0 || rows.at_rest[i]) continue;
    delta[static_cast<std::size_t>(rows.set_point[i])].push_back(rows.delta[i]);
    Omega[static_cast<std::size_t>(rows.set_point[i])].push_back(rows.Omega[i]);
  }
  Pairs pairs;
  for (std::size_t k = 0; k < delta.size(); ++k) {
    const double d = median(delta[k]), w = median(Omega[k]);
    if (std::isfinite(d) && w > 0.0) pairs.delta.push_back(d), pairs.Omega.push_back(w);
  }
  return pairs;
}

Pairs row_pairs(const SweepRows& rows) {
  Pairs pairs;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!rows.at_rest[i] && std::isfinite(rows.delta[i]) && rows.Omega[i] > 0.0)
      pairs.delta.push_back(rows.delta[i]), pairs.Omega.push_back(rows.Omega[i]);
  return pairs;
}

LeastSquaresFit polynomial(const Pairs& pairs, bool with_square, bool in_time_order) {
  const auto n = static_cast<Eigen::Index>(pairs.delta.size());
  const Eigen::VectorXd delta = Eigen::Map<const Eigen::VectorXd>(pairs.delta.data(), n),
                        Omega = Eigen::Map<const Eigen::VectorXd>(pairs.Omega.data(), n);
  Eigen::MatrixXd A(n, with_square ? 3 : 2);
  A.col(0) = delta;
  A.col(1).setOnes();
  if (with_square) A.col(2) = delta.cwiseProduct(delta);
  LeastSquaresProblem problem;
  problem.unknowns = {{"km", Omega.maxCoeff(), Coordinate::positive}, {"Omega_0", 0.0}};
  if (with_square) problem.unknowns.push_back({"bend", 0.0});
  problem.residuals = n;
  problem.evaluate = linear_residuals(A, Omega);
  problem.groups = {{.name = "speed", .in_time_order = in_time_order}};
  return solve_least_squares(problem);
}

double misfit(const LeastSquaresFit& fit, double full_scale) {
  std::vector<double> kept;
  for (Eigen::Index i = 0; i < fit.residuals.size(); ++i)
    if (!fit.rejected[static_cast<std::size_t>(i)]) kept.push_back(fit.residuals(i));
  return 100.0 * root_mean_square(kept) / full_scale;
}

/// Speed at the higher half of the commands against that at the lower half.
bool falls(const Pairs& pairs) {
  const double middle = median(pairs.delta);
  std::vector<double> low, high;
  for (std::size_t i = 0; i < pairs.delta.size(); ++i)
    if (pairs.delta[i] != middle) (pairs.delta[i] < middle ? low : high).push_back(pairs.Omega[i]);
  return median(high) < median(low);
}

}  // namespace

std::optional<CommandCurve> command_curve(const SweepRows& rows) {
  if (rows.delta.empty()) return std::nullopt;
  const bool averaged = rows.is_log || rows.size() > kMostRows;
  const Pairs pairs = averaged ? set_point_pairs(rows) : row_pairs(rows);
  const std::set<double> commands(pairs.delta.begin(), pairs.delta.end());
  if (commands.size() < 3 || pairs.delta.size() < 4) return std::nullopt;
  if (falls(pairs)) return CommandCurve{.delta = pairs.delta, .Omega = pairs.Omega, .falls = true};
  CommandCurve curve{.fit = polynomial(pairs, false, !averaged), .delta = pairs.delta, .Omega = pairs.Omega};
  const double top = std::ranges::max(pairs.Omega);
  curve.misfit_percent_fs = misfit(curve.fit, top);
  if (commands.size() < 4 || pairs.delta.size() < 6) return curve;
  const LeastSquaresFit bent = polynomial(pairs, true, !averaged);
  curve.with_square_percent_fs = misfit(bent, top);
  const double t = bent.value("bend") / bent.std("bend");
  const double p = two_sided_p(t, bent.dof_of(Eigen::VectorXd::Unit(3, 2)));
  const double explained =
      std::sqrt(std::max(0.0, square(curve.misfit_percent_fs) - square(curve.with_square_percent_fs)));
  curve.is_bent = p < 0.01 && explained > kBent;
  return curve;
}

}  // namespace ident
