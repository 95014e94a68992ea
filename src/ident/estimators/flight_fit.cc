// Ceres over the reduced system, in turn with the noise; sandwich covariance.
#include "ident/estimators/flight_fit.h"

#include <algorithm>
#include <cmath>

#include "ident/core/random.h"
#include "ident/estimators/flight_fit_steps.h"

namespace ident {
namespace {

constexpr double kHuber = 4.0;  // standard deviations beyond which a residual counts linearly
// Fall of the cost that is worth a step without exact slopes.
constexpr double kWorthAStep = 0.01;
// Change of a noise level that is good enough to choose the axes of gusts, and after many rounds to stop.
constexpr double kNearly = 0.3;
// Steps before noise is estimated: what the model misses there would pass for noise.
constexpr int kFirstSteps = 4;
// A mean square of residuals, in variances, so large that the model is far from any minimum, and what is made
// of it for the first steps.
constexpr double kFar = 1e4;
constexpr double kCalm = 10.0;
constexpr double kHeldChunk = 0.2, kSureChunk = 0.1;  // lengths of the first chunks, s
constexpr double kMostCalm = 1e4;  // times the variance: few rounds of noise bring that down again

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool finite(const ReducedSystem& system) { return std::isfinite(system.cost) && system.S.allFinite(); }

// What a step has to promise: more than the tolerance, and than a share of what the model misses altogether.
double worth_a_step(const FlightSmoother& smoother, const FlightFitOptions& options) {
  const double missed = smoother.reduced().cost - samples_of(smoother.record());
  return std::max(options.tolerance, options.tolerance_of_misfit * missed);
}

// Mean square of the residuals, in variances.
double square_of(const FlightSmoother& smoother) {
  return smoother.reduced().cost / samples_of(smoother.record());
}

// Chunks before the noise is known, s. Where attitude or rates are not measured, states drift from what
// little holds them.
double first_chunk(const FlightRecord& record) {
  const bool held = record.signals.rates && record.signals.attitude;
  return std::max(held ? kHeldChunk : kSureChunk, 4 * record.interval);
}

// Very far from the minimum, steps follow what noise there is against everything that was known beforehand,
// to where chance takes them. Noise as large as the residuals lets the first ones keep to it; rounds of noise
// bring it down again.
void calm(FlightSmoother& smoother) {
  const double square = square_of(smoother);
  if (!(square > kFar) || !std::isfinite(square)) return;
  NoiseModel noise = smoother.noise();
  for (double& sigma : noise.sigma) sigma *= std::sqrt(std::min(square / kCalm, kMostCalm));
  smoother.set_noise(noise);
}

// Sandwich over blocks of time, never below the naive covariance in any unknown, nor above the prior.
MatrixXd corrected_for_colour(const FlightFit& fit, const MatrixXd& prior) {
  const double n = static_cast<double>(fit.blocks.size());
  if (n < 8) return fit.naive_covariance;
  VectorXd mean = VectorXd::Zero(prior.rows());
  for (const ScoreBlock& block : fit.blocks) mean += block.score / n;
  MatrixXd meat = MatrixXd::Zero(prior.rows(), prior.rows());
  for (const ScoreBlock& block : fit.blocks)
    meat.noalias() += (block.score - mean) * (block.score - mean).transpose();
  meat = meat * (n / (n - 1)) + prior;
  const MatrixXd sandwich = fit.naive_covariance * meat * fit.naive_covariance;
  // Nothing is known worse with the flight than without it.
  const VectorXd most = prior.diagonal().cwiseProduct(fit.naive_covariance.diagonal()).cwiseInverse();
  const VectorXd stretch = sandwich.diagonal()
                               .cwiseQuotient(fit.naive_covariance.diagonal())
                               .cwiseMin(most)
                               .cwiseMax(1.0)
                               .cwiseSqrt();
  return stretch.asDiagonal() * fit.naive_covariance * stretch.asDiagonal();
}

}  // namespace

FlightFit fit_flight(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options) {
  FlightFit fit;
  const auto tell = [&](double share) {
    if (options.progress) options.progress(share);
  };
  VectorXd u = VectorXd::Zero(theta.size());
  double chunk = options.chunk_seconds > 0 ? options.chunk_seconds : first_chunk(record);
  const auto begin = [&] {
    auto begun = std::make_shared<FlightSmoother>(
        record, theta, options.noise.value_or(initial_noise(record)), chunk, options.threads);
    // Gross errors count linearly, but only once the model is near: far from it everything looks gross.
    begun->set_huber(options.estimate_noise || !options.robust ? 1e9 : kHuber);
    if (options.near && options.near->chunks().size() == begun->chunks().size())
      begun->set_states(options.near->states());
    begun->settle(u, 1);
    return begun;
  };
  std::shared_ptr<FlightSmoother> smoother = begin();
  if (options.chunk_seconds <= 0 && !(square_of(*smoother) < kFar)) {
    chunk = std::max(kSureChunk, 4 * record.interval);
    smoother = begin();
  }
  if (options.estimate_noise) calm(*smoother);
  const auto restart = [&] {
    smoother = std::make_shared<FlightSmoother>(record, theta, smoother->noise(), chunk, options.threads);
    smoother->set_huber(options.robust ? kHuber : 1e9);
    smoother->settle(u, 2);
  };
  const auto trust_region = [&](const TrustRegion& region) {
    const SharedMinimum at = by_trust_region(*smoother, u, region);
    u = at.u, fit.steps += at.steps;
  };
  TrustRegion first{.tolerance = 1.0, .near = kNear, .free = false};
  if (options.estimate_noise) first.max_steps = kFirstSteps;
  smoother->set_gentle(true);
  trust_region(first);
  if (options.estimate_noise) smoother->linearize(u, true);
  smoother->set_gentle(false);
  tell(0.3);
  bool axes_chosen = !options.choose_axes;
  for (int round = 0; options.estimate_noise && round < options.noise_rounds; ++round) {
    if (round > 0) smoother->linearize(u, true);
    smoother->accept();
    if (options.robust) smoother->set_huber(kHuber);
    const NoiseModel before = smoother->noise();
    const double change = update_noise(*smoother, 6);
    const double wanted =
        options.chunk_seconds > 0 ? chunk : chunk_for(record, smoother->noise(), options.fine_gusts);
    if (round < 2 && (wanted > 1.5 * chunk || wanted < chunk / 1.5)) {
      chunk = wanted;
      restart();
    }
    tell(0.3 + 0.5 * (round + 1) / options.noise_rounds);
    const bool first_calm = !axes_chosen && change < kNearly;
    if (first_calm) axes_chosen = true, choose_axes(*smoother, u);
    const bool changed = first_calm && smoother->noise().axes != GustAxes::world;
    if (!changed && (change < 0.03 || (round >= 5 && change < kNearly))) break;
    smoother->accept();
    const NewtonStep step = newton_step(*smoother, u);
    if (step.fall < kNear && theta.possible(u + step.du)) {
      u += step.du;
    } else if (finite(smoother->linearize(u))) {
      trust_region({.tolerance = 0.1, .near = kNear, .max_steps = 1});
    } else {  // a sensor that seems to have no noise at all
      smoother->set_noise(before);
      restart();
      break;
    }
  }
  // Far from any minimum states may have been sent where nothing flies: back to what was measured then.
  if (!finite(linearize_at(*smoother, u))) restart();
  const SharedMinimum near =
      minimise_shared(*smoother, u, std::max(worth_a_step(*smoother, options), kWorthAStep));
  u = near.u, fit.steps += near.steps;
  fit.u = u;
  fit.noise = smoother->noise();
  fit.chunk_seconds = chunk;
  fit.smoother = smoother;
  fit.converged = true;
  finish_fit(fit, theta, options);
  tell(1.0);
  return fit;
}

void finish_fit(FlightFit& fit, const Theta& theta, const FlightFitOptions& options) {
  FlightSmoother& smoother = *fit.smoother;
  smoother.set_exact(options.exact);
  const bool exact = options.exact || !finite(linearize_at(smoother, fit.u));  // too coarse for these
  smoother.set_exact(exact);
  linearize_at(smoother, fit.u);
  smoother.accept();
  if (exact) {
    const SharedMinimum at = minimise_shared(smoother, fit.u, worth_a_step(smoother, options));
    fit.u = at.u, fit.steps += at.steps;
  }
  fit.cost = smoother.reduced().cost + theta.prior(fit.u).residual.squaredNorm();
  fit.information = smoother.reduced().S;
  const MatrixXd prior = prior_information(theta, fit.u);
  fit.naive_covariance = inverse_of(fit.information + prior);
  fit.blocks = smoother.score_blocks(options.block_seconds);
  fit.covariance = corrected_for_colour(fit, prior);
  smoother.set_exact(false);
}

VectorXd fit_of_training(const FlightFit& fit, const FlightRecord& record, const Theta& theta,
                         double training_share) {
  const PriorTerms prior = theta.prior(fit.u);
  MatrixXd H = prior_information(theta, fit.u);
  VectorXd g = prior.slope.cwiseProduct(prior.residual);
  for (const ScoreBlock& block : fit.blocks)
    if (block.to <= training_end(record.arcs[static_cast<std::size_t>(block.arc)], training_share))
      H += block.information, g += block.score;
  return fit.u - inverse_of(H) * g;
}

MatrixXd bootstrap_covariance(const FlightFit& fit, const Theta& theta, int draws) {
  const PriorTerms prior = theta.prior(fit.u);
  const MatrixXd own = prior_information(theta, fit.u);
  const auto n = static_cast<int>(fit.blocks.size());
  Random random(20240229);
  MatrixXd sum = MatrixXd::Zero(own.rows(), own.cols());
  for (int draw = 0; draw < draws; ++draw) {
    MatrixXd H = own;
    VectorXd g = prior.slope.cwiseProduct(prior.residual);
    for (Eigen::Index i = 0; i < g.size(); ++i) g[i] += prior.slope[i] * random.normal();
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
