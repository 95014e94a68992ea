// What a regression gains on parts of the flight that it was not fitted to.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "ident/flight/smoother/smoother.h"

namespace ident {

/// Coefficients that are expected, in standard deviations of the noise a unit of a feature: the best is
/// taken.
inline constexpr std::array kRegressionSizes = {1.0, 0.3, 0.1};

/// Fall of the cost on the blocks of each fold, of the unknowns after theta fitted to the others with
/// coefficients of about `size`; beyond what theta alone does there.
double held_out_gain(const std::vector<ScoreBlock>& blocks, const PriorTerms& prior, double size);

/// Weighted residuals of a sensor, summed over pieces of flight, and how many there are in each.
struct SensorResiduals {
  Eigen::VectorXd sum, count;
};

/// Fall of the cost on the pieces of each fold, of a regression on the rows of X (one a piece) fitted to the
/// others with the best of the expected sizes; `parts` numbers stretches of some seconds.
double held_out_gain(const SensorResiduals& residuals, const Eigen::MatrixXd& X,
                     const std::vector<int>& parts);

/// Columns moved to a mean of 0 and scaled to a mean square of 1; those that do not vary to 0.
void standardise(Eigen::MatrixXd& X);

}  // namespace ident
