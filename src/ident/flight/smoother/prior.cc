// Quadratic forms of the prior.
#include "ident/flight/smoother/prior.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace ident {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double PriorTerms::cost_after(const VectorXd& step) const {
  const VectorXd there = residual + slope.cwiseProduct(step);
  return there.dot(precision * there);
}

MatrixXd PriorTerms::information(double least) const {
  MatrixXd out = slope.asDiagonal() * precision * slope.asDiagonal();
  out.diagonal() = out.diagonal().cwiseMax(least);
  return out;
}

MatrixXd PriorTerms::root() const {
  return Eigen::LLT<MatrixXd>(precision).matrixU() * MatrixXd(slope.asDiagonal());
}

VectorXd PriorTerms::whitened() const { return Eigen::LLT<MatrixXd>(precision).matrixU() * residual; }

PriorTerms PriorTerms::loosened(Index at, double factor) const {
  PriorTerms out = *this;
  out.residual[at] /= factor, out.slope[at] /= factor;
  out.precision -= precision.col(at) * precision.row(at) / precision(at, at);
  out.precision.row(at).setZero(), out.precision.col(at).setZero();
  out.precision(at, at) = 1.0;
  return out;
}

PriorTerms PriorTerms::extended(Index size) const {
  const Index own = slope.size();
  PriorTerms out{VectorXd::Zero(size), VectorXd::Ones(size), MatrixXd::Identity(size, size)};
  out.residual.head(own) = residual;
  out.slope.head(own) = slope;
  out.precision.topLeftCorner(own, own) = precision;
  return out;
}

MatrixXd inverse_correlation(const MatrixXd& correlation) {
  constexpr double kLeast = 1e-10;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(correlation);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(kLeast).cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace ident
