// The sandwich in the directions that the flight determines.
#include "ident/flight/fit/sandwich_covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <vector>

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTold = 0.05;  // least share of the information on a direction that comes from flight
constexpr double kFewBlocks = 8;

// A symmetric matrix with its eigenvalues between these.
MatrixXd clamped(const MatrixXd& A, double least, double most) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(least).cwiseMin(most).asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace

MatrixXd corrected_for_colour(const MatrixXd& S, const MatrixXd& information,
                              const std::vector<ScoreBlock>& blocks) {
  const double n = static_cast<double>(blocks.size());
  if (n < kFewBlocks) return S;
  VectorXd mean = VectorXd::Zero(S.rows());
  for (const ScoreBlock& block : blocks) mean += block.score / n;
  MatrixXd meat = MatrixXd::Zero(S.rows(), S.rows());
  for (const ScoreBlock& block : blocks)
    meat.noalias() += (block.score - mean) * (block.score - mean).transpose();
  meat *= n / (n - 1);
  const VectorXd std = S.diagonal().cwiseSqrt();
  MatrixXd correlation = std.cwiseInverse().asDiagonal() * S * std.cwiseInverse().asDiagonal();
  correlation.diagonal().array() += 1e-12;  // rounding
  const Eigen::LLT<MatrixXd> factor(correlation);
  if (factor.info() != Eigen::Success) return S;
  const MatrixXd L = std.asDiagonal() * MatrixXd(factor.matrixL());
  const Eigen::SelfAdjointEigenSolver<MatrixXd> shares(L.transpose() * information * L);
  std::vector<Eigen::Index> told;
  for (Eigen::Index i = 0; i < S.rows(); ++i)
    if (shares.eigenvalues()[i] > kTold) told.push_back(i);
  const auto p = static_cast<Eigen::Index>(told.size());
  if (p == 0) return S;
  const MatrixXd D = L * shares.eigenvectors()(Eigen::all, told);
  const VectorXd root = shares.eigenvalues()(told).cwiseMin(1.0).cwiseSqrt();
  MatrixXd K =
      root.cwiseInverse().asDiagonal() * (D.transpose() * meat * D) * root.cwiseInverse().asDiagonal();
  const double usual = K.trace() / static_cast<double>(p);
  const MatrixXd all_alike = usual * MatrixXd::Identity(p, p);
  const double differ = (K - all_alike).squaredNorm() / static_cast<double>(p),
               by_chance = usual * usual * static_cast<double>(p + 1) / n;
  const double drawn = differ > by_chance ? 0.5 * by_chance / differ : 0.5;
  K = clamped((1 - drawn) * K + drawn * all_alike - MatrixXd::Identity(p, p), 0.0, 1e300);
  // The variance of the prior is 1/(1 - s) there, which bounds what may be added to 1.
  const VectorXd c = (1 - root.array().square()).max(1e-12).sqrt(), back = root.cwiseQuotient(c);
  const MatrixXd added =
      back.asDiagonal() * clamped(c.asDiagonal() * K * c.asDiagonal(), 0.0, 1.0) * back.asDiagonal();
  return S + D * added * D.transpose();
}

}  // namespace ident
