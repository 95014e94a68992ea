// The door to least squares: intervals that hold, outliers, colour, rank, groups of unequal noise.
#include "ident/lsq/least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_autodiff.h"
#include "ident/lsq/least_squares_fit.h"
#include "ident/lsq/least_squares_lag_products.h"
#include "ident/lsq/least_squares_result.h"
#include "support/bench_campaign.h"

namespace ident {
namespace {

using bench::ColouredNoise;
using bench::Random;

constexpr double kA = 2.0, kB = 3.0, kC = 5.0;

/// y = a + b exp(-c t), t from 0 to 1.
LeastSquaresProblem decay(const Eigen::VectorXd& y) {
  const Eigen::Index n = y.size();
  LeastSquaresProblem problem{.residuals = n};
  problem.unknowns = {{"a", 1.0}, {"b", 1.0}, {"c", 3.0, Coordinate::positive}};
  problem.evaluate = [y, n](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(n), e = std::exp(-x(2) * t);
      r(i) = x(0) + x(1) * e - y(i);
      if (J) J->row(i) << 1.0, e, -x(1) * t * e;
    }
    return true;
  };
  return problem;
}

Eigen::VectorXd decay_data(Random& random, Eigen::Index n, double rho, double outliers) {
  ColouredNoise noise(random, rho);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    y(i) = kA + kB * std::exp(-kC * static_cast<double>(i) / static_cast<double>(n)) + 0.1 * noise.next();
    if (random.chance(outliers)) y(i) += (random.chance(0.5) ? 1 : -1) * random.uniform(0.8, 4.0);
  }
  return y;
}

/// Share of runs in which the 95 % interval of an unknown holds the truth.
struct Coverage {
  double corrected = 0.0, naive = 0.0, spread = 0.0;
};

Coverage coverage(int runs, std::uint64_t seed, Eigen::Index n, double rho, double outliers) {
  Random random(seed);
  Coverage result;
  for (int run = 0; run < runs; ++run) {
    const LeastSquaresFit fit = solve_least_squares(decay(decay_data(random, n, rho, outliers)));
    const Parameter a = fitted_parameter(fit, "a", "", "");
    result.corrected += (a.ci95[0] <= kA && kA <= a.ci95[1]) / static_cast<double>(runs);
    result.naive += (std::fabs(a.value - kA) < 1.96 * *a.naive_std) / static_cast<double>(runs);
    result.spread += std::pow((a.value - kA) / a.std, 2) / runs;
  }
  return result;
}

// Bounds are four binomial standard errors of 300 runs around 95 %: 90.0 %.
TEST(LeastSquares, IntervalsHoldForWhiteNoise) { EXPECT_GE(coverage(300, 1, 100, 0.0, 0.0).corrected, 0.90); }

TEST(LeastSquares, IntervalsHoldForAutocorrelatedNoiseWhereNaiveOnesFail) {
  const Coverage found = coverage(300, 2, 300, 0.9, 0.0);
  EXPECT_GE(found.corrected, 0.90);
  EXPECT_LT(found.naive, 0.5);  // 35 % in the literature for rho 0.9
}

TEST(LeastSquares, IntervalsHoldWithOutliers) { EXPECT_GE(coverage(300, 3, 200, 0.0, 0.02).corrected, 0.90); }

TEST(LeastSquares, IntervalsHoldForTwelveSamples) {
  EXPECT_GE(coverage(300, 4, 12, 0.0, 0.0).corrected, 0.90);
}

TEST(LeastSquares, FindsTheColourOfTheNoise) {
  Random random(5);
  const LeastSquaresFit fit = solve_least_squares(decay(decay_data(random, 2000, 0.8, 0.0)));
  EXPECT_NEAR(fit.noise[0].rho, 0.8, 0.06);  // 4 sqrt((1 - rho^2)/n)
  EXPECT_NEAR(fit.noise[0].sigma, 0.1, 0.02);
}

TEST(LeastSquares, LeavesOutJustTheOutliers) {
  Random random(6);
  Eigen::VectorXd y = decay_data(random, 200, 0.9, 0.0);
  y(20) += 2.0;
  y(21) -= 2.0;
  y(150) += 1.0;
  const LeastSquaresFit fit = solve_least_squares(decay(y));
  EXPECT_TRUE(fit.rejected[20] && fit.rejected[21] && fit.rejected[150]);
  EXPECT_EQ(fit.noise[0].rejected, 3);
}

TEST(LeastSquares, MatchesOrdinaryLeastSquaresForIndependentNoise) {
  // y = x1 + x2 t at t = 0, 1, 2, 3 with residuals +1, -1, -1, +1 over 1 + 2 t: they are orthogonal to both
  // columns.
  Eigen::MatrixXd A(4, 2);
  A << 1, 0, 1, 1, 1, 2, 1, 3;
  const Eigen::Vector4d y(2, 2, 4, 8);
  LeastSquaresProblem problem{
      .unknowns = {{"x1"}, {"x2"}}, .residuals = 4, .evaluate = linear_residuals(A, y)};
  const LeastSquaresFit fit = solve_least_squares(problem, {.robust = false, .max_colour_order = 0});
  EXPECT_NEAR(fit.value("x1"), 1.0, 1e-12);
  EXPECT_NEAR(fit.value("x2"), 2.0, 1e-12);
  EXPECT_NEAR(fit.std("x2"), std::sqrt(4.0 / 2.0 / 5.0), 1e-12);  // s^2 = 4/(4 - 2), sum (t - mean)^2 = 5
  EXPECT_NEAR(fit.dof_of(Eigen::Vector2d(0, 1)), 2.0, 1e-2);
  const Parameter p = fitted_parameter(fit, "x2", "", "");
  EXPECT_NEAR(p.ci95[1] - p.value, 4.302653 * p.std, 2e-2);  // t(0.975, 2)
}

TEST(LeastSquares, NamesTheDirectionThatTheDataDoNotDetermine) {
  // Only the product of a and b shows: d log a = -d log b changes nothing.
  LeastSquaresProblem problem{.residuals = 30};
  problem.unknowns = {{"a", 1.0, Coordinate::positive}, {"b", 1.0, Coordinate::positive}, {"c", 0.0}};
  Random random(7);
  Eigen::VectorXd y(30);
  for (Eigen::Index i = 0; i < 30; ++i) y(i) = 6.0 * static_cast<double>(i) + 1.0 + 0.1 * random.normal();
  problem.evaluate = [y](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    for (Eigen::Index i = 0; i < 30; ++i) {
      const double t = static_cast<double>(i);
      r(i) = x(0) * x(1) * t + x(2) - y(i);
      if (J) J->row(i) << x(1) * t, x(0) * t, 1.0;
    }
    return true;
  };
  const LeastSquaresFit fit = solve_least_squares(problem);
  EXPECT_EQ(fit.rank, 2);
  ASSERT_EQ(fit.undetermined.cols(), 1);
  EXPECT_NEAR(fit.undetermined(0, 0), -fit.undetermined(1, 0), 1e-9);
  EXPECT_EQ(fit.undetermined(2, 0), 0.0);
  EXPECT_TRUE(std::isinf(fit.std("a")));
  EXPECT_TRUE(std::isfinite(fit.std("c")));
  EXPECT_TRUE(std::isfinite(fit.std_of(Eigen::Vector3d(fit.x(1), fit.x(0), 0))));  // of the product
  EXPECT_FALSE(fitted_parameter(fit, "a", "", "").identifiable);
}

TEST(LeastSquares, WeighsGroupsByTheirOwnNoise) {
  // One constant, measured by 40 rows with noise 1 and by 40 with noise 0.01: the second sort decides.
  Random random(8);
  Eigen::VectorXd y(80);
  for (Eigen::Index i = 0; i < 80; ++i) y(i) = 5.0 + (i < 40 ? 1.0 : 0.01) * random.normal();
  LeastSquaresProblem problem{.unknowns = {{"x"}}, .residuals = 80};
  problem.evaluate = linear_residuals(Eigen::MatrixXd::Ones(80, 1), y);
  problem.groups = {{.name = "coarse"}, {.name = "fine"}};
  problem.series = {{0, 40, 0}, {40, 80, 1}};
  const LeastSquaresFit fit = solve_least_squares(problem);
  EXPECT_NEAR(fit.std("x"), 0.01 / std::sqrt(40.0), 0.0008);
  EXPECT_NEAR(fit.noise[0].sigma, 1.0, 0.5);
  EXPECT_NEAR(fit.noise[1].sigma, 0.01, 0.005);
}

TEST(LeastSquares, ChangesOfUnitsChangeNothing) {
  Random random(9);
  const Eigen::VectorXd y = decay_data(random, 200, 0.5, 0.01);
  const LeastSquaresFit plain = solve_least_squares(decay(y));
  LeastSquaresProblem scaled = decay(y);
  const ResidualFunction inner = scaled.evaluate;
  scaled.evaluate = [inner](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    const bool ok = inner(Eigen::Vector3d(x(0) * 1e6, x(1) * 1e6, x(2)), r, J);
    r *= 1e-3;
    if (J) *J *= 1e-3 * Eigen::Vector3d(1e6, 1e6, 1).asDiagonal();
    return ok;
  };
  for (Unknown& u : scaled.unknowns)
    if (u.coordinate == Coordinate::real) u.start *= 1e-6;
  const LeastSquaresFit other = solve_least_squares(scaled);
  EXPECT_NEAR(other.value("c"), plain.value("c"), 1e-6 * plain.value("c"));
  EXPECT_NEAR(other.std("a") * 1e6, plain.std("a"), 1e-4 * plain.std("a"));
}

TEST(LeastSquares, JetsAndHandWrittenDerivativesAgree) {
  Random random(10);
  const Eigen::VectorXd y = decay_data(random, 50, 0.0, 0.0);
  const auto automatic = differentiated([y](const auto* x, auto* r) {
    for (Eigen::Index i = 0; i < y.size(); ++i)
      r[i] = x[0] + x[1] * exp(-x[2] * (static_cast<double>(i) / static_cast<double>(y.size()))) - y(i);
    return true;
  });
  const Eigen::Vector3d x(1.5, 2.5, 4.0);
  Eigen::VectorXd r1(50), r2(50);
  Eigen::MatrixXd J1 = Eigen::MatrixXd::Zero(50, 3), J2 = J1;
  automatic(x, r1, &J1);
  decay(y).evaluate(x, r2, &J2);
  EXPECT_TRUE(r1.isApprox(r2, 1e-14));
  EXPECT_TRUE(J1.isApprox(J2, 1e-14));
}

TEST(Colour, WhitensExactlyAlsoAcrossGaps) {
  // Whitened rows of the unit matrix are the Cholesky factor's inverse: W K W' = 1 with K the covariance.
  const Colour colour(Eigen::Vector2d(0.8, -0.4));
  const Eigen::Index n = 12;
  std::vector<bool> missing(n, false);
  missing[4] = missing[5] = missing[9] = true;
  Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n), K(n, n);
  const double log_variances = colour.whiten(0, n, missing, W);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) K(i, k) = colour.covariance(std::abs(i - k));
    if (!missing[static_cast<std::size_t>(i)]) kept.push_back(i);
  }
  const Eigen::MatrixXd left = W(kept, Eigen::all), inner = K(kept, kept);
  EXPECT_NEAR(log_variances, std::log(inner.determinant()), 1e-3);
  EXPECT_TRUE((left * K * left.transpose()).isApprox(Eigen::MatrixXd::Identity(9, 9), 1e-3));
  for (const Eigen::Index i : {4, 5, 9}) EXPECT_TRUE(left.col(i).isZero());
}

TEST(LagProducts, GiveTheSumsOfDecorrelatedRows) {
  Random random(11);
  Eigen::MatrixXd rows(60, 3);
  for (double& v : rows.reshaped()) v = random.normal();
  std::vector<bool> missing(60, false);
  missing[0] = missing[20] = missing[22] = missing[23] = true;
  LagProducts products(3, 4);
  products.add(rows, missing);
  for (const Eigen::VectorXd& partial : {Eigen::VectorXd(0), Eigen::VectorXd(Eigen::Vector2d(0.9, 0.3))}) {
    const Colour colour(partial);
    Eigen::MatrixXd white = rows;
    const double log_variances = colour.whiten(0, 60, missing, white);
    for (Eigen::Index i = 0; i < 60; ++i)
      if (missing[static_cast<std::size_t>(i)]) white.row(i).setZero();
    const DecorrelatedSums sums = products.sums(colour);
    EXPECT_TRUE(sums.JJ.isApprox(white.leftCols(2).transpose() * white.leftCols(2), 1e-10));
    EXPECT_NEAR(sums.rr, white.col(2).squaredNorm(), 1e-9);
    EXPECT_NEAR(sums.log_variances, log_variances, 1e-10);
  }
}

}  // namespace
}  // namespace ident
