// Sandwich covariance: corrects the covariance for residuals that are correlated in time.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/flight/smoother/smoother.h"

namespace ident {

/// Sandwich over blocks of time. The correction is a matrix, so that correlations stay as they are: a factor
/// on each standard deviation would break the correlation of thrust and inertia. `naive` is the covariance
/// with the priors, `information` that of the flight alone.
///
/// In the directions that the flight determines (its share of the information is s, that of the prior 1 - s)
/// K is the scatter of the scores over that of white residuals. A few dozen blocks determine K badly. So it
/// is shrunk towards its mean by half of what chance explains of their difference [after Ledoit & Wolf 2004],
/// because too wide costs less than too narrow, and it is at least 1. In no combination is the variance
/// larger than that of the prior. With fewer than eight blocks the result is `naive`.
Eigen::MatrixXd corrected_for_colour(const Eigen::MatrixXd& naive, const Eigen::MatrixXd& information,
                                     const std::vector<ScoreBlock>& blocks);

}  // namespace ident
