// Level and colour of the noise by restricted maximum likelihood, and what their uncertainty does to
// intervals.
#pragma once

#include <vector>

#include "ident/estimators/least_squares.h"
#include "ident/estimators/least_squares_whitening.h"

namespace ident {

/// Noise of one group: innovations of standard deviation `sigma` with that colour.
struct GroupNoise {
  double sigma = 1.0;
  Colour colour;
};

/// Residuals and Jacobian at the solution, with the rows that are left out.
struct LinearisedRows {
  Eigen::MatrixXd J;  ///< columns of the determined directions only
  Eigen::VectorXd r;
  std::vector<bool> missing;
};

/// Divides rows by level and colour of their noise; rows that are missing keep their prediction error.
/// Returns sum log(variance) over the rows that are there.
double whiten(const std::vector<ResidualSeries>& series, const std::vector<GroupNoise>& noise,
              const std::vector<bool>& missing, Eigen::MatrixXd& rows);

/// Restricted maximum likelihood, the order of the colour by information criterion. `noise` is the start.
std::vector<GroupNoise> estimate_noise(const LeastSquaresProblem& problem, int max_colour_order,
                                       const LinearisedRows& rows, std::vector<GroupNoise> noise);

/// Covariance of the unknowns, its derivative along each constant of the noise (log variance, then
/// atanh of the partial autocorrelations, group by group), and the covariance of those constants.
struct NoiseSensitivity {
  Eigen::MatrixXd covariance;
  std::vector<Eigen::MatrixXd> slopes;
  Eigen::MatrixXd constants_covariance;
};
NoiseSensitivity noise_sensitivity(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                                   const std::vector<GroupNoise>& noise);

}  // namespace ident
