// Ceres over the reduced system, in turn with the noise; sandwich covariance.
#include "ident/estimators/flight_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/random.h"
#include "ident/estimators/least_squares_minimise.h"

namespace ident {
namespace {

constexpr double kHuber = 4.0;  // standard deviations beyond which a residual counts linearly
// A step that promises less than this fall of the cost is near the minimum.
constexpr double kNear = 25.0;
// There a step has to leave no more than this share of what was promised before it.
constexpr double kShrinks = 0.7;
// What is left where steps near the minimum lead nowhere, for a trust region to be worth its time.
constexpr double kStuck = 1.0;
// Fall of the cost that is worth a step with exact slopes.
constexpr double kWorthAStep = 0.01;
constexpr int kMostSteps = 30;
// Trust region, in standard deviations of each unknown alone, after a step without one has failed.
constexpr double kShort = 1.0;
// Steps from there that fail one after the other: the next would be a thousandth of it.
constexpr int kRejected = 5;
// Steps before noise is estimated: what the model misses there would pass for noise.
constexpr int kFirstSteps = 4;

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// S = F'F by eigenvalues: S may be singular where the data tell nothing. Gives F and F^-T g (within its
/// range).
struct Factor {
  MatrixXd F;
  VectorXd r;
};
Factor factor(const MatrixXd& S, const VectorXd& g) {
  const VectorXd scale = S.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const MatrixXd scaled = scale.cwiseInverse().asDiagonal() * S * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
  const VectorXd h = eigen.eigenvectors().transpose() * scale.cwiseInverse().asDiagonal() * g;
  VectorXd root(h.size()), r(h.size());
  const double smallest = 1e-13 * eigen.eigenvalues().maxCoeff();
  for (Eigen::Index i = 0; i < h.size(); ++i) {
    const double lambda = eigen.eigenvalues()[i];
    root[i] = lambda > smallest ? std::sqrt(lambda) : 0.0;
    r[i] = root[i] > 0 ? h[i] / root[i] : 0.0;
  }
  return {root.asDiagonal() * eigen.eigenvectors().transpose() * scale.asDiagonal(), r};
}

MatrixXd prior_information(const Theta& theta, const VectorXd& u) {
  const VectorXd slope = theta.prior(u).slope;
  // Without any prior a factor of e is allowed per standard deviation: keeps undetermined directions in
  // place.
  VectorXd info = slope.cwiseAbs2();
  for (int i = 0; i < theta.size(); ++i)
    if (slope[i] == 0) info[i] = 1e-2;
  return info.asDiagonal();
}

MatrixXd inverse_of(const MatrixXd& M) {
  const VectorXd s = M.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = s.asDiagonal() * M * s.asDiagonal();
  const MatrixXd inverse = Eigen::LDLT<MatrixXd>(scaled).solve(MatrixXd::Identity(M.rows(), M.cols()));
  return s.asDiagonal() * inverse * s.asDiagonal();
}

// To the minimum of the quadratic form, and how far the cost falls there.
struct Newton {
  VectorXd du;
  double fall;
};
Newton newton_step(const ReducedSystem& system, const Theta& theta, const VectorXd& u) {
  const PriorTerms prior = theta.prior(u);
  const VectorXd g = system.g + prior.slope.cwiseProduct(prior.residual);
  const VectorXd du = -inverse_of(system.S + prior_information(theta, u)) * g;
  return {du, -g.dot(du)};
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

// Ceres' trust region over the shared unknowns, until a whole step promises less than `near` or nothing is
// gained. `free` of a first radius: it would hold a step back along directions that only priors determine,
// which are weak beside those that the flight does.
VectorXd by_trust_region(FlightSmoother& smoother, const VectorXd& start, double tolerance, double near,
                         int max_steps, bool free, int& steps, double& cost) {
  const Theta& theta = smoother.theta();
  const int n = theta.size();
  VectorXd last;
  ReducedSystem system;
  SteppedProblem problem;
  problem.residuals = 2 * n + 1;
  double samples = 1;
  for (const FlightArc& arc : smoother.record().arcs)
    samples += static_cast<double>(std::ranges::count_if(arc.y, [](double y) { return std::isfinite(y); }));
  problem.tolerance = tolerance / samples;  // the cost is about one a sample
  problem.max_steps = max_steps;
  problem.evaluate = [&](const VectorXd& u, VectorXd& r, MatrixXd* J) {
    if (!theta.possible(u)) return false;
    if (last.size() == 0 || u != last) {
      system = smoother.stands_at(u) ? smoother.relinearize() : smoother.linearize(u);
      last = u;
    }
    if (!std::isfinite(system.cost) || !system.S.allFinite()) {
      last.resize(0);
      return false;
    }
    if (J) smoother.accept();
    const Factor f = factor(system.S, system.g);
    const PriorTerms prior = theta.prior(u);
    r.head(n) = f.r;
    r[n] = std::sqrt(std::max(system.cost - f.r.squaredNorm(), 0.0));
    r.tail(n) = prior.residual;
    if (J) {
      J->topRows(n) = f.F;
      J->bottomRows(n) = MatrixXd(prior.slope.asDiagonal());
    }
    return true;
  };
  problem.enough = [&] { return last.size() > 0 && newton_step(system, theta, last).fall < near; };
  if (free) problem.initial_radius = 1e12, problem.most_rejected = 1;
  SteppedMinimum best = minimise_stepped(problem, start);
  if (free && best.rejected) {  // from that far it would take ten more to shrink to where a step helps
    steps += best.steps;
    problem.initial_radius = kShort, problem.most_rejected = kRejected;
    best = minimise_stepped(problem, best.u);
  }
  steps += best.steps;
  cost = 2 * best.cost;
  if (!best.ok)
    throw DataError("the flight model cannot be simulated with these constants: check the vehicle file");
  return best.u;
}

// Newton's steps where they are near the minimum, until less than `enough` is promised: moves `u`, gives the
// fall that is left. The smoother is linearised and accepted there.
// It is this promise that judges a step. The cost is known only up to what the states gain by a step of their
// own, and near the minimum that is more than the shared unknowns do.
double newton_steps(FlightSmoother& smoother, VectorXd& u, double enough, int& steps, double& cost) {
  const Theta& theta = smoother.theta();
  const auto accepted = [&](const VectorXd& at) {
    if (smoother.stands_at(at))
      smoother.relinearize();
    else
      smoother.linearize(at);
    smoother.accept();
    cost = smoother.reduced().cost + theta.prior(at).residual.squaredNorm();
    return newton_step(smoother.reduced(), theta, at);
  };
  Newton step = accepted(u);
  for (int i = 0; i < kMostSteps && step.fall > enough && step.fall < kNear; ++i) {
    const VectorXd next = u + step.du;
    if (!theta.possible(next)) break;
    smoother.linearize(next);
    ++steps;
    if (!(newton_step(smoother.reduced(), theta, next).fall < kShrinks * step.fall)) {
      smoother.linearize(u);
      return accepted(u).fall;
    }
    step = accepted(next);
    u = next;
  }
  return step.fall;
}

}  // namespace

VectorXd minimise_shared(FlightSmoother& smoother, const VectorXd& start, double enough, int* steps,
                         double* cost) {
  VectorXd u = start;
  int taken = 0;
  double at = 0.0;
  double left = newton_steps(smoother, u, enough, taken, at);
  if (!(left < kNear)) {
    u = by_trust_region(smoother, u, enough, kNear, kMostSteps, true, taken, at);
    left = newton_steps(smoother, u, enough, taken, at);
  }
  if (!(left < std::max(enough, kStuck))) {
    u = by_trust_region(smoother, u, enough, 0.0, kMostSteps, true, taken, at);
    newton_steps(smoother, u, enough, taken, at);
  }
  if (steps) *steps += taken;
  if (cost) *cost = at;
  return u;
}

FlightFit fit_flight(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options) {
  FlightFit fit;
  const auto tell = [&](double share) {
    if (options.progress) options.progress(share);
  };
  double chunk = options.chunk_seconds > 0 ? options.chunk_seconds : std::max(0.1, 4 * record.interval);
  auto smoother = std::make_shared<FlightSmoother>(
      record, theta, options.noise.value_or(initial_noise(record)), chunk, options.threads);
  // Gross errors count linearly, but only once the model is near: far from it everything looks gross.
  smoother->set_huber(options.estimate_noise || !options.robust ? 1e9 : kHuber);
  VectorXd u = VectorXd::Zero(theta.size());
  smoother->settle(u, 1);
  const auto restart = [&] {
    smoother = std::make_shared<FlightSmoother>(record, theta, smoother->noise(), chunk, options.threads);
    smoother->set_huber(options.robust ? kHuber : 1e9);
    smoother->settle(u, 2);
  };
  if (options.estimate_noise)
    u = by_trust_region(*smoother, u, 1.0, kWorthAStep, kFirstSteps, false, fit.steps, fit.cost);
  else
    u = by_trust_region(*smoother, u, 1.0, kNear, kMostSteps, false, fit.steps, fit.cost);
  tell(0.3);
  for (int round = 0; options.estimate_noise && round < options.noise_rounds; ++round) {
    smoother->linearize(u, true);
    smoother->accept();
    if (options.robust) smoother->set_huber(kHuber);
    const double change = update_noise(*smoother, 6);
    const double wanted =
        options.chunk_seconds > 0 ? chunk : chunk_for(record, smoother->noise(), options.fine_gusts);
    if (round < 2 && (wanted > 1.5 * chunk || wanted < chunk / 1.5)) {
      chunk = wanted;
      restart();
    }
    tell(0.3 + 0.5 * (round + 1) / options.noise_rounds);
    if (change < 0.03 || (round >= 5 && change < 0.3)) break;
    smoother->accept();
    const Newton step = newton_step(smoother->reduced(), theta, u);
    if (step.fall < kNear && theta.possible(u + step.du))
      u += step.du;
    else
      u = by_trust_region(*smoother, u, 0.1, kWorthAStep, 1, true, fit.steps, fit.cost);
  }
  // Far from any minimum states may have been sent where nothing flies: back to what was measured then.
  if (!std::isfinite(smoother->linearize(u).cost)) restart();
  // Where links let next to no noise through, the rounding of single precision would pass for information:
  // the last steps are exact.
  u = minimise_shared(*smoother, u, std::max(options.tolerance, kWorthAStep), &fit.steps);
  smoother->set_exact(true);
  u = minimise_shared(*smoother, u, std::min(options.tolerance, kWorthAStep), &fit.steps, &fit.cost);
  const ReducedSystem system = smoother->reduced();
  fit.u = u;
  fit.information = system.S;
  fit.noise = smoother->noise();
  fit.chunk_seconds = chunk;
  const MatrixXd prior = prior_information(theta, u);
  fit.naive_covariance = inverse_of(system.S + prior);
  fit.blocks = smoother->score_blocks(options.block_seconds);
  fit.covariance = corrected_for_colour(fit, prior);
  smoother->set_exact(false);
  fit.smoother = smoother;
  fit.converged = true;
  tell(1.0);
  return fit;
}

VectorXd fit_of_blocks(const FlightFit& fit, const Theta& theta,
                       const std::function<bool(const ScoreBlock&)>& take) {
  const PriorTerms prior = theta.prior(fit.u);
  MatrixXd H = prior_information(theta, fit.u);
  VectorXd g = prior.slope.cwiseProduct(prior.residual);
  for (const ScoreBlock& block : fit.blocks)
    if (take(block)) H += block.information, g += block.score;
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
