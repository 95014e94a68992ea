// Covariance by QR of a scaled Jacobian, Satterthwaite's degrees of freedom, parameters of a result.
#include "ident/lsq/least_squares_uncertainty.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_sensitivity.h"

namespace ident {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// (A'A)^-1 for A of full rank, by QR of A with columns of length 1.
Eigen::MatrixXd inverse_of_square(const Eigen::MatrixXd& A) {
  if (A.cols() == 0) return Eigen::MatrixXd(0, 0);
  const Eigen::VectorXd length = A.colwise().norm();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A * length.cwiseInverse().asDiagonal());
  const Eigen::Index n = A.cols();
  const Eigen::MatrixXd inverse =
      qr.matrixQR().topRows(n).template triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd scaled = length.cwiseInverse().asDiagonal() * inverse;
  return scaled * scaled.transpose();
}

Eigen::MatrixXd without(Eigen::MatrixXd rows, const std::vector<bool>& missing) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    if (missing[static_cast<std::size_t>(i)]) rows.row(i).setZero();
  return rows;
}

/// As if every residual were independent: one level for each group.
Eigen::MatrixXd naive_covariance(const LeastSquaresProblem& problem, const LinearisedRows& rows) {
  std::vector<double> squares(problem.groups.size(), 0.0), counts(problem.groups.size(), 0.0);
  double all = 0.0;
  for (const ResidualSeries& s : problem.series)
    for (Eigen::Index i = s.begin; i < s.end; ++i) {
      if (rows.missing[static_cast<std::size_t>(i)]) continue;
      squares[static_cast<std::size_t>(s.group)] += rows.r(i) * rows.r(i);
      counts[static_cast<std::size_t>(s.group)] += 1.0;
      all += 1.0;
    }
  // The unknowns' share is taken off the groups in proportion to their size.
  const double share = std::max(1.0 - static_cast<double>(rows.J.cols()) / std::max(all, 1.0), 1e-3);
  Eigen::MatrixXd weighted = without(rows.J, rows.missing);
  for (const ResidualSeries& s : problem.series) {
    const auto g = static_cast<std::size_t>(s.group);
    const double sigma = problem.groups[g].known_sigma.value_or(std::sqrt(squares[g] / (counts[g] * share)));
    weighted.middleRows(s.begin, s.end - s.begin) /= std::max(sigma, 1e-100);
  }
  return inverse_of_square(weighted);
}

/// Unknowns that take part in an undetermined direction have no finite variance.
Eigen::MatrixXd with_infinite_variance(Eigen::MatrixXd C, const Eigen::MatrixXd& undetermined) {
  for (Eigen::Index i = 0; i < C.rows(); ++i) {
    if (undetermined.cols() == 0 || undetermined.row(i).isZero(0.0)) continue;
    C.row(i).setZero();
    C.col(i).setZero();
    C(i, i) = kInfinity;
  }
  return C;
}

NoiseEstimate described(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                        const GroupNoise& noise, std::size_t group) {
  NoiseEstimate estimate{.name = problem.groups[group].name,
                         .sigma = noise.sigma * std::sqrt(noise.colour.variance()),
                         .rho = noise.colour.order() > 0 ? noise.colour.rho() : 0.0};
  const Eigen::VectorXd& phi = noise.colour.phi();
  estimate.ar.assign(phi.data(), phi.data() + phi.size());
  for (const ResidualSeries& s : problem.series) {
    if (static_cast<std::size_t>(s.group) != group) continue;
    const auto out = std::count(rows.missing.begin() + s.begin, rows.missing.begin() + s.end, true);
    estimate.rejected += out;
    estimate.used += s.end - s.begin - out;
  }
  return estimate;
}

/// Likelihood with the level that fits best, so that models with more unknowns can be compared. A row that
/// was left out counts as if it lay on the edge of what is believed: otherwise leaving out would be rewarded.
void set_likelihood(LeastSquaresFit& fit, const LeastSquaresProblem& problem, double log_variances) {
  double n = 0.0;
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    double squares = 0.0, rows = 0.0, left_out = 0.0;
    for (const ResidualSeries& s : problem.series)
      for (Eigen::Index i = s.begin; static_cast<std::size_t>(s.group) == g && i < s.end; ++i) {
        if (fit.rejected[static_cast<std::size_t>(i)])
          left_out += 1.0;
        else
          squares += fit.standardized(i) * fit.standardized(i), rows += 1.0;
      }
    n += rows;
    const double cut = outlier_cut(static_cast<std::size_t>(rows + left_out)), sigma = fit.noise[g].sigma;
    log_variances += left_out * (cut * cut + 2.0 * std::log(sigma));
    if (problem.groups[g].known_sigma)
      log_variances += squares;
    else if (rows > 0.0)
      log_variances += rows * (1.0 + std::log(std::max(squares, 1e-300) / rows));
  }
  fit.minus_two_log_likelihood = log_variances + n * std::log(2.0 * M_PI);
  double constants = fit.rank;
  for (std::size_t g = 0; g < problem.groups.size(); ++g)
    if (!problem.groups[g].known_sigma) constants += 1.0 + static_cast<double>(fit.noise[g].ar.size());
  fit.bic = fit.minus_two_log_likelihood + constants * std::log(std::max(n, 1.0));
  fit.degrees_of_freedom = n - fit.rank;
}

/// Second moment about the solution over all draws.
Eigen::MatrixXd covariance_over(const std::vector<NoiseDraw>& draws) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(draws[0].shift.size(), draws[0].shift.size());
  for (const NoiseDraw& draw : draws)
    C += draw.weight * (draw.covariance + draw.shift * draw.shift.transpose());
  return C;
}

}  // namespace

Directions determined_directions(const Eigen::MatrixXd& weighted_J, double rank_tolerance) {
  const Eigen::Index n = weighted_J.cols();
  if (weighted_J.rows() == 0 || weighted_J.isZero(0.0))
    return {Eigen::MatrixXd(n, 0), Eigen::MatrixXd::Identity(n, n)};
  Eigen::VectorXd length = weighted_J.colwise().norm();
  for (Eigen::Index i = 0; i < n; ++i)
    if (!(length(i) > 0.0)) length(i) = 1.0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(weighted_J * length.cwiseInverse().asDiagonal());
  qr.setThreshold(rank_tolerance);
  const Eigen::Index rank = qr.rank();
  if (rank == n) return {Eigen::MatrixXd::Identity(n, n), Eigen::MatrixXd(n, 0)};
  // R = [R1 R2; 0 0]: the null space is spanned by (-R1^-1 R2, 1) in pivoted, scaled coordinates.
  const Eigen::MatrixXd R = qr.matrixR().topRows(rank);
  Eigen::MatrixXd null(n, n - rank);
  null.topRows(rank) = -R.leftCols(rank).template triangularView<Eigen::Upper>().solve(R.rightCols(n - rank));
  null.bottomRows(n - rank).setIdentity();
  null = qr.colsPermutation() * null;
  for (Eigen::Index k = 0; k < null.cols(); ++k) {
    const double largest = null.col(k).cwiseAbs().maxCoeff();
    for (double& component : null.col(k))
      if (std::fabs(component) < 1e-6 * largest) component = 0.0;
  }
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(null).householderQ();
  Directions result{length.cwiseInverse().asDiagonal() * Q.rightCols(rank),
                    length.cwiseInverse().asDiagonal() * null};
  for (Eigen::Index k = 0; k < n - rank; ++k)
    result.undetermined.col(k) /= result.undetermined.col(k).cwiseAbs().maxCoeff();
  return result;
}

Eigen::VectorXd leverages(const Eigen::MatrixXd& weighted_J, const std::vector<bool>& missing) {
  const Eigen::MatrixXd C = inverse_of_square(without(weighted_J, missing));
  return (weighted_J * C).cwiseProduct(weighted_J).rowwise().sum();
}

LeastSquaresFit fit_with_uncertainty(const LeastSquaresProblem& problem, const Eigen::VectorXd& x,
                                     const LinearisedRows& rows, const Directions& directions,
                                     const std::vector<GroupNoise>& noise) {
  LeastSquaresFit fit;
  const Eigen::Index n = x.size();
  fit.x = x;
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);  // d x / d coordinate
  for (Eigen::Index i = 0; i < n; ++i) {
    const Unknown& unknown = problem.unknowns[static_cast<std::size_t>(i)];
    fit.names.push_back(unknown.name);
    fit.coordinates.push_back(unknown.coordinate);
    if (unknown.coordinate == Coordinate::positive) scale(i) = x(i);
  }
  const Eigen::MatrixXd V = scale.asDiagonal() * directions.determined;
  fit.rank = static_cast<int>(directions.determined.cols());
  fit.undetermined = directions.undetermined;

  Eigen::MatrixXd weighted(rows.r.size(), rows.J.cols() + 1);
  weighted << rows.J, rows.r;
  const double log_variances = whiten(problem.series, noise, rows.missing, weighted);
  fit.directions = V;
  fit.noise_draws = noise_draws(problem, rows, noise);
  fit.determined_covariance =
      V *
      (fit.noise_draws.empty() ? inverse_of_square(without(weighted.leftCols(rows.J.cols()), rows.missing))
                               : covariance_over(fit.noise_draws)) *
      V.transpose();
  fit.covariance = with_infinite_variance(fit.determined_covariance, directions.undetermined);
  fit.naive_covariance =
      with_infinite_variance(V * naive_covariance(problem, rows) * V.transpose(), directions.undetermined);
  if (fit.noise_draws.empty()) {
    const NoiseSensitivity sensitivity = noise_sensitivity(problem, rows, noise);
    for (const Eigen::MatrixXd& slope : sensitivity.slopes)
      fit.covariance_slopes.push_back(V * slope * V.transpose());
    fit.noise_constants_covariance = sensitivity.constants_covariance;
  }

  fit.residuals = rows.r;
  fit.rejected = rows.missing;
  fit.standardized = weighted.col(rows.J.cols());
  fit.residual_sigma.resize(rows.r.size());
  for (std::size_t g = 0; g < noise.size(); ++g) fit.noise.push_back(described(problem, rows, noise[g], g));
  for (const ResidualSeries& s : problem.series)
    fit.residual_sigma.segment(s.begin, s.end - s.begin)
        .setConstant(fit.noise[static_cast<std::size_t>(s.group)].sigma);
  set_likelihood(fit, problem, log_variances);
  for (Eigen::Index i = 0; i < fit.standardized.size(); ++i)
    if (fit.rejected[static_cast<std::size_t>(i)]) fit.standardized(i) = kNaN;
  return fit;
}

}  // namespace ident
