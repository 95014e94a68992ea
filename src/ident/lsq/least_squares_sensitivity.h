// How well level and colour of the noise are known, and what that does to the unknowns.
#pragma once

#include "ident/lsq/least_squares_noise.h"

namespace ident {

/// Derivative of the unknowns' covariance along each constant of the noise (log variance, then atanh of the
/// partial autocorrelations, group by group), and the covariance of those constants.
struct NoiseSensitivity {
  std::vector<Eigen::MatrixXd> slopes;
  Eigen::MatrixXd constants_covariance;
};
NoiseSensitivity noise_sensitivity(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                                   const std::vector<GroupNoise>& noise);

/// Constants of the noise drawn from what the data say of them, for coloured noise: with few
/// rows its colour is known too badly for the linear picture above. Each draw carries the solution that it
/// would have given (less the one there is) and its covariance; weights sum to 1. Empty for white noise.
std::vector<NoiseDraw> noise_draws(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                                   const std::vector<GroupNoise>& noise);

}  // namespace ident
