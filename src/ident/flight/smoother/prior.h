// The prior of the shared unknowns: a normal distribution with its whole covariance.
#pragma once

#include <Eigen/Core>

namespace ident {

/// The prior at the present unknowns. Its cost is residual' precision residual.
struct PriorTerms {
  Eigen::VectorXd residual;   ///< one per unknown, in standard deviations of what was known; 0 without prior
  Eigen::VectorXd slope;      ///< derivative with respect to its own unknown; 0 without prior
  Eigen::MatrixXd precision;  ///< inverse of the correlation of what was known; identity where independent

  double cost() const { return residual.dot(precision * residual); }
  /// The cost after a small step of the unknowns.
  double cost_after(const Eigen::VectorXd& step) const;
  /// Half the derivative of the cost.
  Eigen::VectorXd gradient() const { return slope.cwiseProduct(precision * residual); }
  /// Information (inverse covariance) about the unknowns; at least `least` of each alone.
  Eigen::MatrixXd information(double least = 0.0) const;
  /// R with R'R the information, and R^-T times the gradient: the prior as residuals.
  Eigen::MatrixXd root() const;
  Eigen::VectorXd whitened() const;

  /// With `factor` times the standard deviation of unknown `at`, which is then independent of the others.
  PriorTerms loosened(Eigen::Index at, double factor) const;
  /// With further unknowns, each with prior 0 +- 1.
  PriorTerms extended(Eigen::Index size) const;
};

/// Inverse of a correlation matrix. No combination counts as known more than a hundred thousand times as well
/// as its constants: beyond that it would be rounding.
Eigen::MatrixXd inverse_correlation(const Eigen::MatrixXd& correlation);

}  // namespace ident
