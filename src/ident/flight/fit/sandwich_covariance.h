// Covariance where residuals are coloured in time: what scores scatter by, in place of what white residuals
// would make them scatter by.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/flight/smoother/smoother.h"

namespace ident {

/// Sandwich over blocks of time, as a matrix, so that what is known together stays so: with deviations alone
/// stretched each by its own, thrust and inertia would no longer go together as they do. `naive` is the
/// covariance with the priors, `information` that of the flight alone.
///
/// In the directions that the flight tells (its share of the information is s, the prior's 1 - s) the scatter
/// over that of white residuals is K. A few dozen blocks tell K badly: it is drawn towards its mean by half
/// of what chance explains that it differs by [after Ledoit & Wolf 2004], too wide costing less than too
/// narrow, and is at least 1. Nothing is known worse with the flight than without it, in no combination.
/// Fewer than eight blocks tell nothing: naive.
Eigen::MatrixXd corrected_for_colour(const Eigen::MatrixXd& naive, const Eigen::MatrixXd& information,
                                     const std::vector<ScoreBlock>& blocks);

}  // namespace ident
