// The end of a fit: minimum, covariance, and the constants by parts of the flight alone.
#include "ident/flight/fit/fit_covariance.h"

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/random.h"
#include "ident/core/stage_times.h"
#include "ident/flight/fit/fit_steps.h"
#include "ident/flight/fit/sandwich_covariance.h"
#include "ident/flight/record/excerpts.h"

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Decrease of the cost below which the last step needs no evaluation: the next one would be 1e-4 of it.
constexpr double kSure = 0.5;
// Slopes in single precision have errors of 1e-7, and the information errors of about 1e-6 times the square
// root of (information with all states known times variance). Below this limit of the product no error was
// above 1 % in any direction.
constexpr double kSingleServes = 1e6;
// A minimum by exact slopes may have this many times the cost: it is nearly the same place.
constexpr double kAstray = 1.5;

// Whether the rounding of single precision could count as information: with next to no noise little of what
// the rows say of a constant is left once the states are free.
bool rounding_shows(const FlightSmoother& smoother, const MatrixXd& covariance) {
  const VectorXd held = smoother.information_of_held_states();
  const auto n = held.size();
  return n > 0 && !(held.cwiseProduct(covariance.diagonal().head(n)).maxCoeff() < kSingleServes);
}

}  // namespace

double worth_a_step(const FlightSmoother& smoother, const FlightFitOptions& options) {
  const double missed = smoother.reduced().cost - samples_of(smoother.record());
  return std::max(options.tolerance, options.tolerance_of_misfit * missed);
}

void finish_fit(FlightFit& fit, const Theta& theta, const FlightFitOptions& options, bool at_minimum) {
  const Stage stage("covariance");
  FlightSmoother& smoother = *fit.smoother;
  const auto minimum = [&](bool in_double) {
    smoother.set_exact(in_double);
    if (!is_finite(linearize_at(smoother, fit.u)) && !in_double) return false;
    smoother.accept();
    if (at_minimum && !in_double) return true;
    const SharedMinimum at =
        minimise_shared(smoother, fit.u, worth_a_step(smoother, options), options.most_steps);
    fit.u = at.u, fit.steps += at.steps;
    return true;
  };
  const auto by_all = [&] { return posterior(smoother.reduced().S, prior_information(theta, fit.u)); };
  if (options.exact) smoother.set_steps(Steps::fine);
  // Slopes in single precision may be too coarse to simulate anything.
  if (!minimum(false)) {
    minimum(true);
  } else if (options.exact && rounding_shows(smoother, by_all().covariance)) {
    const std::vector<FlightState<double>> states = smoother.states();
    const VectorXd u = fit.u;
    const double before = smoother.reduced().cost;
    bool astray = false;  // states that are hardly determined may go astray
    try {
      minimum(true);
      astray = !(smoother.reduced().cost < kAstray * before + 1);
    } catch (const DataError&) {
      astray = true;
    }
    if (astray) {
      smoother.set_exact(false);
      smoother.set_states(states);
      linearize_at(smoother, fit.u = u);
      smoother.accept();
    }
  }
  fit.cost = smoother.reduced().cost + theta.prior(fit.u).cost();
  Posterior all = by_all();
  fit.information = std::move(all.information), fit.naive_covariance = std::move(all.covariance);
  fit.blocks = smoother.score_blocks(options.block_seconds);
  if (const NewtonStep last = newton_step(smoother, fit.u);
      last.fall < kSure && is_short(theta, fit.u, last.du)) {
    fit.u += last.du, fit.cost -= last.fall;
    for (ScoreBlock& block : fit.blocks) block.score += block.information * last.du;
  }
  fit.covariance = corrected_for_colour(fit.naive_covariance, fit.information, fit.blocks);
  smoother.set_exact(false);
}

VectorXd fit_of_training(const FlightFit& fit, const FlightRecord& record, const Theta& theta,
                         double training_share) {
  const PriorTerms prior = theta.prior(fit.u);
  MatrixXd H = prior_information(theta, fit.u);
  VectorXd g = prior.gradient();
  for (const ScoreBlock& block : fit.blocks)
    if (block.to <= training_end(record.arcs[static_cast<std::size_t>(block.arc)], training_share))
      H += block.information, g += block.score;
  return fit.u - inverse_of(H) * g;
}

MatrixXd bootstrap_covariance(const FlightFit& fit, const Theta& theta, int draws) {
  const PriorTerms prior = theta.prior(fit.u);
  const MatrixXd own = prior_information(theta, fit.u), known = prior.root();
  const auto n = static_cast<int>(fit.blocks.size());
  Random random(20240229);
  MatrixXd sum = MatrixXd::Zero(own.rows(), own.cols());
  for (int draw = 0; draw < draws; ++draw) {
    MatrixXd H = own;
    VectorXd g = prior.gradient();
    g += known.transpose() * VectorXd::NullaryExpr(g.size(), [&](Eigen::Index) { return random.normal(); });
    for (int b = 0; b < n; ++b) {
      const ScoreBlock& block = fit.blocks[static_cast<std::size_t>(random.below(n))];
      H += block.information, g += block.score;
    }
    const VectorXd step = inverse_of(H) * g;
    sum.noalias() += step * step.transpose() / draws;
  }
  return sum;
}

}  // namespace ident
