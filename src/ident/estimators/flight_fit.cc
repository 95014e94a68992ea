// Ceres over the reduced system, fixed-point noise levels, sandwich covariance.
#include "ident/estimators/flight_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/estimators/least_squares_minimise.h"

namespace ident {
namespace {

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

double rms_rate_of(const FlightRecord& record, int channel) {
  double sum = 0, n = 0;
  for (const FlightArc& arc : record.arcs) {
    double y0 = kNaN, t0 = 0;
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      const double y = arc.y[i * kChannels + static_cast<std::size_t>(channel)];
      if (!std::isfinite(y)) continue;
      if (!std::isfinite(y0)) y0 = y, t0 = arc.t[i];
      if (arc.t[i] - t0 < 0.05) continue;
      const double rate = (y - y0) / (arc.t[i] - t0);
      sum += rate * rate, n += 1, y0 = y, t0 = arc.t[i];
    }
  }
  return n > 0 ? std::sqrt(sum / n) : 0.0;
}

}  // namespace

NoiseModel initial_noise(const FlightRecord& record) {
  NoiseModel noise;
  noise.sigma = record.sigma;
  double w = 0, v = 0;
  for (int k = 0; k < 3; ++k) {
    w = std::max(w, rms_rate_of(record, kGyro + k));
    v = std::max(v, rms_rate_of(record, kVelocity + k));
  }
  if (v == 0) v = 2.0;
  if (w == 0) w = 5.0;
  noise.q_w = std::pow(0.2 * w, 2) * 0.02;
  noise.q_v = std::pow(0.1 * v, 2) * 0.1;
  noise.q_motor = record.signals.rotor_speeds ? 1.0 : 0.0;
  return noise;
}

double update_noise(FlightSmoother& smoother) {
  const Moments m = smoother.moments();
  NoiseModel noise = smoother.noise();
  double change = 0;
  for (std::size_t c = 0; c < kChannels; ++c) {
    const double free = m.count[c] - m.leverage[c];
    if (m.count[c] < 8 || free < 0.02 * m.count[c]) continue;
    const double factor = std::clamp(m.square[c] / free, 0.05, 20.0);
    noise.sigma[c] = std::max(noise.sigma[c] * std::sqrt(factor), 1e-10);
    change = std::max(change, std::abs(std::sqrt(factor) - 1));
  }
  const auto update = [&](std::size_t group, double& q) {
    if (m.defect_count[group] < 4 || q <= 0) return;
    // MacKay's fixed point: the squared defects over the number of defects that the data determine.
    const double determined = m.defect_count[group] - m.defect_variance[group] / q;
    const double fixed_point = m.defect_square[group] / std::max(determined, 0.02 * m.defect_count[group]);
    const double next = std::clamp(fixed_point, 0.02 * q, 50 * q);
    change = std::max(change, 0.3 * std::abs(std::sqrt(next / q) - 1));
    q = next;
  };
  update(0, noise.q_w);
  update(1, noise.q_v);
  update(2, noise.q_motor);
  smoother.set_noise(noise);
  return change;
}

double chunk_for(const FlightRecord& record, const NoiseModel& noise) {
  // Time in which the process noise grows to what the measurements tell: sqrt(r/q), r = sigma^2 per second of
  // samples.
  double tau = 1.0;
  const auto shorten = [&](int channel, double q) {
    double samples = 0;
    for (const FlightArc& arc : record.arcs)
      for (std::size_t i = 0; i < arc.rows(); ++i)
        samples += std::isfinite(arc.y[i * kChannels + static_cast<std::size_t>(channel)]);
    if (samples > 0 && q > 0)
      tau = std::min(
          tau, noise.sigma[static_cast<std::size_t>(channel)] * std::sqrt(record.duration / samples / q));
  };
  shorten(kGyro, noise.q_w);
  shorten(kVelocity, noise.q_v);
  return std::clamp(tau, std::max(2.0 * record.interval, 0.02), 1.0);
}

VectorXd minimise_shared(FlightSmoother& smoother, const VectorXd& start, double tolerance, int max_steps,
                         int* steps, double* cost) {
  const Theta& theta = smoother.theta();
  const int n = theta.size();
  VectorXd last;
  ReducedSystem system;
  SteppedProblem problem;
  problem.residuals = 2 * n + 1;
  problem.tolerance = tolerance;
  problem.max_steps = max_steps;
  problem.evaluate = [&](const VectorXd& u, VectorXd& r, MatrixXd* J) {
    if (last.size() == 0 || u != last) {
      system = smoother.linearize(u);
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
  const SteppedMinimum best = minimise_stepped(problem, start);
  if (steps) *steps += best.steps;
  if (cost) *cost = 2 * best.cost;
  if (!best.ok)
    throw DataError("the flight model cannot be simulated with these constants: check the vehicle file");
  return best.u;
}

FlightFit fit_flight(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options) {
  FlightFit fit;
  NoiseModel noise = options.noise.value_or(initial_noise(record));
  const auto tell = [&](double share) {
    if (options.progress) options.progress(share);
  };
  double chunk =
      options.chunk_seconds > 0 ? options.chunk_seconds : std::clamp(8 * record.interval, 0.05, 0.25);
  auto smoother = std::make_shared<FlightSmoother>(record, theta, noise, chunk, options.threads);
  const double huber = options.robust ? 4.0 : 1e9;
  smoother->set_huber(huber);
  VectorXd u = VectorXd::Zero(theta.size());
  smoother->settle(u, 2);
  u = minimise_shared(*smoother, u, 1e-4, 8, &fit.steps);
  tell(0.3);
  for (int round = 0; options.estimate_noise && round < options.noise_rounds; ++round) {
    smoother->settle(u, 1);
    const double change = update_noise(*smoother);
    const double wanted = options.chunk_seconds > 0 ? chunk : chunk_for(record, smoother->noise());
    if (wanted > 1.5 * chunk || wanted < chunk / 1.5) {
      noise = smoother->noise();
      chunk = wanted;
      smoother = std::make_shared<FlightSmoother>(record, theta, noise, chunk, options.threads);
      smoother->set_huber(huber);
      smoother->settle(u, 2);
    }
    u = minimise_shared(*smoother, u, 1e-5, 3, &fit.steps);
    tell(0.3 + 0.5 * (round + 1) / options.noise_rounds);
    if (change < 0.03) break;
  }
  u = minimise_shared(*smoother, u, options.tolerance, 30, &fit.steps, &fit.cost);
  smoother->settle(u, 1);
  const ReducedSystem system = smoother->linearize(u);
  smoother->accept();
  fit.u = u;
  fit.information = system.S;
  fit.noise = smoother->noise();
  fit.chunk_seconds = chunk;
  const MatrixXd prior = prior_information(theta, u);
  fit.naive_covariance = inverse_of(system.S + prior);
  // Sandwich over blocks of time, never below the naive one in any direction of interest (the diagonal).
  const MatrixXd scores = smoother->block_scores(options.block_seconds);
  const double blocks = static_cast<double>(scores.cols());
  fit.covariance = fit.naive_covariance;
  if (blocks >= 8) {
    const MatrixXd centred = scores.colwise() - scores.rowwise().mean();
    const MatrixXd meat = centred * centred.transpose() * (blocks / (blocks - 1)) + prior;
    const MatrixXd sandwich = fit.naive_covariance * meat * fit.naive_covariance;
    VectorXd stretch(u.size());
    for (int i = 0; i < u.size(); ++i)
      stretch[i] = std::sqrt(std::max(1.0, sandwich(i, i) / fit.naive_covariance(i, i)));
    fit.covariance = stretch.asDiagonal() * fit.naive_covariance * stretch.asDiagonal();
  }
  fit.smoother = smoother;
  fit.converged = true;
  tell(1.0);
  return fit;
}

}  // namespace ident
