// Score test with the spread of the scores over blocks.
#include "ident/flight/fit/score_test.h"

#include <algorithm>
#include <cmath>

#include "ident/flight/fit/fit_steps.h"

namespace ident {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double contradiction(const Theta& theta, const FlightFit& fit, Eigen::Index at) {
  constexpr double kMattersTest = 1e-3;         // of the unit step; less is rounding
  constexpr std::ptrdiff_t kFewBlocksTest = 8;  // too few to tell how much coloured residuals spread;
  constexpr double kUntold = 4.0;               // this factor is assumed then
  PriorTerms prior = theta.prior(fit.u).loosened(at, 1.0);
  prior.slope[at] = 0;
  const Eigen::Index n = fit.u.size();
  MatrixXd F = MatrixXd::Zero(n, n), H = prior.information();
  VectorXd g = prior.gradient();
  for (const ScoreBlock& block : fit.blocks) F += block.information, g += block.score;
  H += F;
  H.diagonal() *= 1 + 1e-12;  // undetermined directions
  const MatrixXd covariance = inverse_of(H);
  const VectorXd direction = covariance.col(at), step = -covariance * g;
  if (!(std::abs(step[at]) > kMattersTest && direction[at] > 0)) return 0;
  double spread = 0;
  for (const ScoreBlock& block : fit.blocks)
    spread += std::pow(direction.dot(block.score + block.information * step), 2);
  const bool few = std::ssize(fit.blocks) < kFewBlocksTest;
  const double stretch = few ? kUntold : std::max(spread / direction.dot(F * direction), 1.0);
  return step[at] * step[at] / (direction[at] * stretch);
}

bool may_be_nothing(const Theta& theta, const FlightFit& fit, const std::string& name, double deviations) {
  const double power_of_km = name == "Omega_0" ? -1 : name == "Jp" ? 1 : 0;
  VectorXd relative = VectorXd::Zero(fit.u.size());
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    if (c.name == name) relative[i] = theta.slope(fit.u, i) / (theta.physical(fit.u, i) - c.start);
    if (c.index == param::km) relative[i] = power_of_km * theta.slope(fit.u, i) / theta.physical(fit.u, i);
  }
  return !(deviations * deviations * relative.dot(fit.covariance * relative) < 1);
}

}  // namespace ident
