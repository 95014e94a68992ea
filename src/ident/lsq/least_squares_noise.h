// Level and colour of the noise by restricted maximum likelihood, and what their uncertainty does to
// intervals.
#pragma once

#include <vector>

#include "ident/lsq/least_squares.h"
#include "ident/lsq/least_squares_whitening.h"

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

/// What is looked for: with the order fixed it is that of the start.
struct NoiseSearch {
  int max_colour_order = 0;
  bool order_is_free = true;
};

/// Restricted maximum likelihood, the order of the colour by information criterion. `noise` is the start.
std::vector<GroupNoise> estimate_noise(const LeastSquaresProblem& problem, const NoiseSearch& search,
                                       const LinearisedRows& rows, std::vector<GroupNoise> noise);

}  // namespace ident
