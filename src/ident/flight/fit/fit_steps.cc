// Ceres' trust region and Newton steps over the reduced system.
#include "ident/flight/fit/fit_steps.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/lsq/least_squares.h"
#include "ident/lsq/least_squares_minimise.h"

namespace ident {
namespace {

// A Newton step is taken if the next one promises at most this share of its decrease.
constexpr double kShrinks = 0.7;
// Decrease that is still promised where Newton steps fail, for a trust region to be worth its time.
constexpr double kStuck = 1.0;
constexpr int kMostSteps = 30;
// Trust region after a step without one has failed, in standard deviations of each unknown alone.
constexpr double kShort = 1.0;
// Rejected steps in a row that end it: the next one would be a thousandth of the first.
constexpr int kRejectedShort = 5;
// Most by which a step may change the logarithm of a constant, a factor of twenty: slopes at its start say
// nothing so far away, and a simulation there is lost time.
constexpr double kFarthest = 3.0;

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// S = F'F by eigenvalues, because S may be singular. Gives F and F^-T g (within its range).
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

// Whether a step changes no logarithm of a constant by more than `most`.
bool keeps_within(const Theta& theta, const VectorXd& du, double most) {
  for (int i = 0; i < theta.constants_count(); ++i)
    if (theta.constants()[static_cast<std::size_t>(i)].positive && !(std::abs(du[i]) < most)) return false;
  return true;
}

// The smoother as residuals of the shared unknowns, for Ceres: r'r is the cost, J'J the information.
class SharedResiduals {
 public:
  SharedResiduals(FlightSmoother& smoother, bool leverage) : smoother_(&smoother), leverage_(leverage) {}

  bool operator()(const VectorXd& u, VectorXd& r, MatrixXd* J) {
    const Theta& theta = smoother_->theta();
    const int n = theta.size();
    if (!theta.possible(u) || (from_.size() > 0 && !keeps_within(theta, u - from_, kFarthest))) return false;
    if (last_.size() == 0 || u != last_) linearize_at(*smoother_, u, leverage_);
    last_ = u;
    const ReducedSystem& system = smoother_->reduced();
    if (!is_finite(system)) {
      last_.resize(0);
      return false;
    }
    if (J) smoother_->accept(), from_ = u;
    const Factor f = factor(system.S, system.g);
    const PriorTerms prior = theta.prior(u);
    r.head(n) = f.r;
    r[n] = std::sqrt(std::max(system.cost - f.r.squaredNorm(), 0.0));
    r.tail(n) = prior.whitened();
    if (J) {
      J->topRows(n) = f.F;
      J->bottomRows(n) = prior.root();
    }
    return true;
  }

  bool promises_less_than(double fall) const {
    return last_.size() > 0 && newton_step(*smoother_, last_).fall < fall;
  }

 private:
  FlightSmoother* smoother_;
  bool leverage_;
  VectorXd last_;  // empty where the simulation diverges
  VectorXd from_;  // the last that was accepted
};

// Newton steps near the minimum, until less than `enough` is promised; returns the decrease that is still
// promised. Steps are judged by this promise: the cost is known only up to what the states would gain by
// another step, which near the minimum is more than the shared unknowns gain.
double newton_steps(FlightSmoother& smoother, SharedMinimum& at, double enough, int most_steps) {
  linearize_at(smoother, at.u);
  smoother.accept();
  NewtonStep step = newton_step(smoother, at.u);
  for (int i = 0; i < most_steps && step.fall > enough && step.fall < kNear; ++i) {
    const VectorXd next = at.u + step.du;
    if (!smoother.theta().possible(next) || !keeps_within(smoother.theta(), step.du, kFarthest)) break;
    smoother.linearize(next);
    ++at.steps;
    const NewtonStep further = newton_step(smoother, next);
    const bool taken = further.fall < kShrinks * step.fall;
    if (!taken) smoother.linearize(at.u);
    smoother.accept();
    if (taken) at.u = next;
    step = taken ? further : newton_step(smoother, at.u);
    if (!taken) break;
  }
  at.cost = smoother.reduced().cost + smoother.theta().prior(at.u).cost();
  return step.fall;
}

}  // namespace

const ReducedSystem& linearize_at(FlightSmoother& smoother, const VectorXd& u, bool leverage) {
  return smoother.stands_at(u) ? smoother.relinearize() : smoother.linearize(u, leverage);
}

bool is_finite(const ReducedSystem& system) {
  // Where a simulation has diverged, rounding makes a sum of squares negative. Motors that follow their
  // commands with next to no noise make the largest decrease that means anything, some 1e20.
  constexpr double kRounding = 1e-3, kRanAway = 1e30;
  return std::isfinite(system.cost) && std::abs(system.fall) < kRanAway &&
         system.cost >= -kRounding * std::abs(system.fall) && system.S.allFinite() && system.g.allFinite();
}

double samples_of(const FlightRecord& record) {
  double samples = 1;
  for (const FlightArc& arc : record.arcs)
    samples += static_cast<double>(std::ranges::count_if(arc.y, [](double y) { return std::isfinite(y); }));
  return samples;
}

MatrixXd prior_information(const Theta& theta, const VectorXd& u) {
  const PriorTerms prior = theta.prior(u);
  // Without a prior: one unit with a standard deviation of 10.
  MatrixXd info = prior.information();
  for (int i = 0; i < theta.size(); ++i)
    if (prior.slope[i] == 0) info(i, i) = 1e-2;
  return info;
}

MatrixXd inverse_of(const MatrixXd& M) {
  const VectorXd s = M.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = s.asDiagonal() * M * s.asDiagonal();
  const MatrixXd inverse = Eigen::LDLT<MatrixXd>(scaled).solve(MatrixXd::Identity(M.rows(), M.cols()));
  return s.asDiagonal() * inverse * s.asDiagonal();
}

Posterior posterior(const MatrixXd& information, const MatrixXd& prior) {
  constexpr double kRounding = 1e-8;  // of the largest eigenvalue, scaled; 3e-9 was seen
  const VectorXd s = (information + prior).diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(s.asDiagonal() * information * s.asDiagonal());
  const VectorXd& values = eigen.eigenvalues();
  const VectorXd told = (values.array() > kRounding * values.maxCoeff()).select(values, 0.0);
  const MatrixXd root = s.cwiseInverse().asDiagonal() * eigen.eigenvectors() *
                        told.cwiseSqrt().asDiagonal();  // of the information
  // In units of the prior, prior = L L': undetermined directions keep a variance of one, however well others
  // are determined.
  const Eigen::LLT<MatrixXd> L(prior);
  const Eigen::JacobiSVD<MatrixXd> shares(L.matrixL().solve(root), Eigen::ComputeFullU);
  const VectorXd left = (1 + shares.singularValues().array().square()).inverse();
  const MatrixXd axes = L.matrixU().solve(shares.matrixU());
  return {axes * left.asDiagonal() * axes.transpose(), root * root.transpose()};
}

NewtonStep newton_step(const FlightSmoother& smoother, const VectorXd& u) {
  const ReducedSystem& system = smoother.reduced();
  const PriorTerms prior = smoother.theta().prior(u);
  const VectorXd g = system.g + prior.gradient();
  const VectorXd du = -inverse_of(system.S + prior_information(smoother.theta(), u)) * g;
  return {du, -g.dot(du)};
}

bool is_short(const Theta& theta, const VectorXd& u, const VectorXd& du) {
  return keeps_within(theta, du, 1.0) && theta.possible(u + du);
}

SharedMinimum by_trust_region(FlightSmoother& smoother, const VectorXd& start, const TrustRegion& region) {
  SharedResiduals residuals(smoother, region.leverage);
  SteppedProblem problem;
  problem.residuals = 2 * smoother.theta().size() + 1;
  problem.tolerance = region.tolerance / samples_of(smoother.record());
  problem.max_steps = region.max_steps;
  problem.evaluate = [&](const VectorXd& u, VectorXd& r, MatrixXd* J) { return residuals(u, r, J); };
  problem.enough = [&] { return residuals.promises_less_than(region.near); };
  if (region.free) problem.initial_radius = 1e12, problem.most_rejected = 1;
  SteppedMinimum best = minimise_stepped(problem, start);
  int steps = best.steps;
  // From so far it would take ten more rejected steps until one helps.
  if (region.free && best.rejected) {
    problem.initial_radius = kShort, problem.most_rejected = kRejectedShort;
    problem.max_steps = std::max(region.max_steps - steps, 1);
    best = minimise_stepped(problem, best.u);
    steps += best.steps;
  }
  if (!best.ok)
    throw DataError("the flight model cannot be simulated with these constants: check the vehicle file");
  return {best.u, 2 * best.cost, steps};
}

SharedMinimum minimise_shared(FlightSmoother& smoother, const VectorXd& start, double enough,
                              int most_steps) {
  SharedMinimum at{start};
  const auto left_of = [&](int most) {
    return most_steps > 0 ? std::min(most, most_steps - at.steps) : most;
  };
  const auto trust_region = [&](double near) {
    const int before = at.steps;
    TrustRegion region{.tolerance = enough, .near = near};
    region.max_steps = left_of(region.max_steps);
    at = by_trust_region(smoother, at.u, region);
    at.steps += before;
  };
  double left = newton_steps(smoother, at, enough, left_of(kMostSteps));
  // Where the model is too nonlinear, steps promise a decrease that no length of step keeps.
  for (const double near : {kNear, 0.0}) {
    if (left < std::max(near, std::max(enough, kStuck))) continue;
    if (left_of(1) < 1) break;
    const double before = at.cost;
    trust_region(near);
    if (!(before - at.cost > enough)) {
      linearize_at(smoother, at.u);
      smoother.accept();
      break;
    }
    left = newton_steps(smoother, at, enough, left_of(kMostSteps));
  }
  return at;
}

}  // namespace ident
