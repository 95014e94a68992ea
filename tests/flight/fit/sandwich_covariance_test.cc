// The correction for colour: wider by what scores scatter, and what goes together stays together.
#include "ident/flight/fit/sandwich_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "ident/core/random.h"

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Blocks whose scores have `colour` times the covariance of what white residuals would give.
std::vector<ScoreBlock> blocks_of(const MatrixXd& information, const MatrixXd& colour, int count,
                                  int seed = 1) {
  Random random(static_cast<std::uint64_t>(seed));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(information);
  const MatrixXd root = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
                        eigen.eigenvectors().transpose();
  const MatrixXd wider = Eigen::LLT<MatrixXd>(colour).matrixL();
  std::vector<ScoreBlock> blocks(static_cast<std::size_t>(count));
  for (ScoreBlock& block : blocks) {
    const VectorXd z = VectorXd::NullaryExpr(3, [&](Eigen::Index) { return random.normal(); });
    block.information = information / count;
    block.score = root * (wider * z) / std::sqrt(count);
  }
  return blocks;
}

double std_of(const MatrixXd& V, const VectorXd& combination) {
  return std::sqrt(combination.dot(V * combination));
}

const MatrixXd kOne = MatrixXd::Identity(3, 3);

TEST(Colour, WhiteResidualsHardlyChangeTheCovariance) {
  const MatrixXd F = Eigen::Vector3d(4, 9, 1).asDiagonal(), S = (F + 0.01 * kOne).inverse();
  const MatrixXd V = corrected_for_colour(S, F, blocks_of(F, kOne, 400));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::sqrt(V(i, i) / S(i, i)), 1.03, 0.05);
}

TEST(Colour, ScatteringScoresWidenTheDirectionsTheyDetermine) {
  const MatrixXd F = Eigen::Vector3d(4, 9, 1).asDiagonal(), S = (F + 0.01 * kOne).inverse();
  const MatrixXd V = corrected_for_colour(S, F, blocks_of(F, 4 * kOne, 400));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::sqrt(V(i, i) / S(i, i)), 2.0, 0.2);
  const MatrixXd one = Eigen::Vector3d(1, 9, 1).asDiagonal();
  const MatrixXd W = corrected_for_colour(S, F, blocks_of(F, one, 4000));
  EXPECT_NEAR(std::sqrt(W(1, 1) / S(1, 1)), 3.0, 0.3);
  EXPECT_NEAR(std::sqrt(W(0, 0) / S(0, 0)), 1.0, 0.1);
}

// x + y is known to a thousandth, each of them by the prior alone; z goes with them as (x + y) z. Colour
// of 1.3 squared makes the sum 1.3 times as wide, and leaves x and y what they were.
TEST(Colour, CorrelationsArePreserved) {
  Eigen::Vector3d sum(1, 1, 0), with_z(1, 1, -1);
  const MatrixXd F = 1e6 * (sum * sum.transpose() + 4 * with_z * with_z.transpose()),
                 S = (F + kOne).inverse();
  const MatrixXd V = corrected_for_colour(S, F, blocks_of(F, 1.69 * kOne, 60));
  EXPECT_NEAR(std::sqrt(V(0, 0) / S(0, 0)), 1.0, 1e-3);
  EXPECT_NEAR(std_of(V, sum) / std_of(S, sum), 1.3, 0.2);
  EXPECT_NEAR(std_of(V, with_z) / std_of(S, with_z), 1.3, 0.2);
}

// Two constants that the bench knows by their difference, and a flight full of colour.
TEST(Colour, NoCombinationIsWorseThanItsPrior) {
  MatrixXd C{{1, 0.99, 0}, {0.99, 1, 0}, {0, 0, 1}};
  const MatrixXd prior = C.inverse();
  const Eigen::Vector3d difference(1, -1, 0);
  for (const double told : {0.3, 1.0, 30.0, 1e4}) {
    const MatrixXd F = told * Eigen::Vector3d(40, 60, 1).asDiagonal().toDenseMatrix(),
                   S = (F + prior).inverse();
    const MatrixXd V = corrected_for_colour(S, F, blocks_of(F, 50 * kOne, 40));
    EXPECT_GT(std_of(V, difference), 0.999 * std_of(S, difference));
    for (const VectorXd& w : {VectorXd(difference), VectorXd(Eigen::Vector3d(1, 1, 0)), VectorXd(kOne.col(0)),
                              VectorXd(kOne.col(2)), VectorXd(Eigen::Vector3d(1, -1, 0.5))})
      EXPECT_LT(std_of(V, w), 1.001 * std_of(C, w)) << told;
  }
}

TEST(Colour, FewBlocksLeaveTheCovarianceUnchanged) {
  const MatrixXd F = kOne, S = (F + 0.01 * kOne).inverse();
  EXPECT_EQ(corrected_for_colour(S, F, blocks_of(F, 9 * kOne, 7)), S);
}

// Nothing told, and scores that do not differ at all.
TEST(Colour, NoInformationLeavesTheCovarianceUnchanged) {
  const MatrixXd none = MatrixXd::Zero(3, 3);
  EXPECT_EQ(corrected_for_colour(kOne, none, blocks_of(none, kOne, 40)), kOne);
  std::vector<ScoreBlock> alike = blocks_of(kOne, kOne, 40);
  for (ScoreBlock& block : alike) block.score.setConstant(1.0);
  const MatrixXd S = (2 * kOne).inverse();
  EXPECT_LT((corrected_for_colour(S, kOne, alike) - S).norm(), 1e-12);
}

}  // namespace
}  // namespace ident
