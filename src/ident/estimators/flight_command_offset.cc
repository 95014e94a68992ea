// The fit widened by the offset of the command.
#include "ident/estimators/flight_command_offset.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ident {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool needs_command_offset(const Vehicle& vehicle, const FlightRecord& record, const Theta& theta,
                          const FlightFit& fit) {
  const auto is_offset = [](const FreeConstant& c) { return c.index == param::Omega_0; };
  if (!record.signals.commands || vehicle.has("Omega_0") || std::ranges::any_of(theta.constants(), is_offset))
    return false;
  const std::vector<double> p = theta.p(fit.u);
  std::vector<FreeConstant> constants = theta.constants();
  for (FreeConstant& c : constants) c.start = p[static_cast<std::size_t>(c.index)];
  const std::vector<FreeConstant> all = free_constants(vehicle, p, {"Omega_0"});
  constants.push_back(*std::ranges::find_if(all, is_offset));
  const Theta wider(p, constants, record.logs, record.signals.rates);
  VectorXd u = VectorXd::Zero(wider.size());
  const int biases = wider.size() - wider.constants_count();
  u.tail(biases) = fit.u.tail(biases);
  FlightSmoother smoother(record, wider, fit.noise, fit.chunk_seconds);
  smoother.set_states(fit.smoother->states());
  smoother.set_exact(true);  // the offset may hide in what single precision rounds away
  FlightFit view;
  view.u = u;
  smoother.linearize(u);
  smoother.accept();
  view.blocks = smoother.score_blocks(2.0);
  if (view.blocks.size() < 8) return false;
  // What the offset gains, over the factor by which coloured residuals spread the scores that it leaves.
  const PriorTerms prior = wider.prior(u);
  MatrixXd F = MatrixXd::Zero(u.size(), u.size()), H = prior.slope.cwiseAbs2().asDiagonal();
  VectorXd g = prior.slope.cwiseProduct(prior.residual);
  for (const ScoreBlock& block : view.blocks) F += block.information, g += block.score;
  H += F;
  const VectorXd s = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = s.asDiagonal() * H * s.asDiagonal();
  scaled.diagonal().array() += 1e-12;
  const Eigen::LDLT<MatrixXd> solver(scaled);
  const auto solved = [&](const VectorXd& x) {
    return VectorXd(s.asDiagonal() * solver.solve(s.asDiagonal() * x));
  };
  const VectorXd direction = solved(VectorXd::Unit(u.size(), wider.constants_count() - 1));
  double spread = 0;
  const VectorXd step = -solved(g);
  for (const ScoreBlock& block : view.blocks)
    spread += std::pow(direction.dot(block.score + block.information * step), 2);
  const double stretch = std::max(spread / direction.dot(F * direction), 1.0);
  constexpr double kBeyondDoubt = 25.0;  // fall of the cost: five standard deviations
  constexpr double kMatters = 1e-3;      // of the unit step, a tenth of the speed at hover: less is rounding
  return g.dot(solved(g)) > kBeyondDoubt * stretch && std::abs(step[wider.constants_count() - 1]) > kMatters;
}

}  // namespace ident
