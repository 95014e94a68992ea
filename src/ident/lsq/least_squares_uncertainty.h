// Rank, covariance and intervals of a least-squares solution.
#pragma once

#include "ident/lsq/least_squares_noise.h"

namespace ident {

/// Directions in the space of the unknowns (unconstrained coordinates), one a column.
struct Directions {
  Eigen::MatrixXd determined;    ///< those in which the residuals change
  Eigen::MatrixXd undetermined;  ///< the others; largest component 1
};

/// Decided on the Jacobian with columns scaled to length 1, by a QR with column pivots: constants may differ
/// by twelve powers of ten.
Directions determined_directions(const Eigen::MatrixXd& weighted_J, double rank_tolerance);

/// Share of each row in its own fit; for a missing row what it would add.
Eigen::VectorXd leverages(const Eigen::MatrixXd& weighted_J, const std::vector<bool>& missing);

/// Everything a caller learns about the solution x.
LeastSquaresFit fit_with_uncertainty(const LeastSquaresProblem& problem, const Eigen::VectorXd& x,
                                     const LinearisedRows& rows, const Directions& directions,
                                     const std::vector<GroupNoise>& noise);

}  // namespace ident
