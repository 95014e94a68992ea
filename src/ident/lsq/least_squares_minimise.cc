// The only place that talks to Ceres: dense QR, tolerances at rounding level, several initial trust regions.
#include "ident/lsq/least_squares_minimise.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <cmath>
#include <limits>

namespace ident {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// All residuals as one block of all unknowns; positive unknowns as their logarithm.
class DenseCost : public ceres::CostFunction {
 public:
  DenseCost(const LeastSquaresProblem& problem, const RowTransform& transform)
      : problem_(problem), transform_(transform), n_(static_cast<Eigen::Index>(problem.unknowns.size())) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(n_));
    set_num_residuals(static_cast<int>(problem.residuals));
  }

  Eigen::VectorXd physical(const double* z) const {
    Eigen::VectorXd x(n_);
    for (Eigen::Index i = 0; i < n_; ++i) x(i) = is_positive(i) ? std::exp(z[i]) : z[i];
    return x;
  }

  Eigen::VectorXd unconstrained(const Eigen::VectorXd& x) const {
    Eigen::VectorXd z(n_);
    for (Eigen::Index i = 0; i < n_; ++i) z(i) = is_positive(i) ? std::log(x(i)) : x(i);
    return z;
  }

  /// Are residuals and Jacobian finite there?
  bool possible(const Eigen::VectorXd& z) const {
    Eigen::VectorXd r(problem_.residuals);
    RowMajor J(problem_.residuals, n_);
    const double* unknowns = z.data();
    double* jacobian = J.data();
    return Evaluate(&unknowns, r.data(), &jacobian);
  }

  bool Evaluate(double const* const* z, double* residuals, double** jacobians) const override {
    const Eigen::VectorXd x = physical(z[0]);
    const bool with_jacobian = jacobians && jacobians[0];
    Eigen::VectorXd r(problem_.residuals);
    Eigen::MatrixXd J;
    if (with_jacobian) J.setZero(problem_.residuals, n_);
    if (!x.allFinite() || !problem_.evaluate(x, r, with_jacobian ? &J : nullptr) || !r.allFinite())
      return false;
    for (Eigen::Index i = 0; with_jacobian && i < n_; ++i)
      if (is_positive(i)) J.col(i) *= x(i);
    transform_(r, with_jacobian ? &J : nullptr);
    if (!r.allFinite() || !J.allFinite()) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, r.size()) = r;
    if (with_jacobian) Eigen::Map<RowMajor>(jacobians[0], r.size(), n_) = J;
    return true;
  }

 private:
  bool is_positive(Eigen::Index i) const {
    return problem_.unknowns[static_cast<std::size_t>(i)].coordinate == Coordinate::positive;
  }

  const LeastSquaresProblem& problem_;
  const RowTransform& transform_;
  Eigen::Index n_;
};

/// A SteppedProblem as one block.
class SteppedCost : public ceres::CostFunction {
 public:
  SteppedCost(const SteppedProblem& problem, Eigen::Index n) : problem_(problem), n_(n) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(n));
    set_num_residuals(static_cast<int>(problem.residuals));
  }

  bool Evaluate(double const* const* u, double* residuals, double** jacobians) const override {
    const bool with_jacobian = jacobians && jacobians[0];
    Eigen::VectorXd r(problem_.residuals);
    Eigen::MatrixXd J;
    if (with_jacobian) J.setZero(problem_.residuals, n_);
    const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(u[0], n_);
    if (!problem_.evaluate(at, r, with_jacobian ? &J : nullptr) || !r.allFinite() || !J.allFinite())
      return false;
    Eigen::Map<Eigen::VectorXd>(residuals, r.size()) = r;
    if (with_jacobian) Eigen::Map<RowMajor>(jacobians[0], r.size(), n_) = J;
    return true;
  }

 private:
  const SteppedProblem& problem_;
  Eigen::Index n_;
};

ceres::Solver::Options solver_options(Effort effort, double radius) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.initial_trust_region_radius = radius;
  // Looser tolerances report convergence at values that are wrong by a factor of 100 (NIST problems).
  const double tolerance = effort == Effort::coarse ? 1e-8 : 1e-18;
  options.function_tolerance = tolerance;
  options.gradient_tolerance = 1e-18;
  options.parameter_tolerance = tolerance;
  options.max_num_iterations = effort == Effort::coarse ? 60 : effort == Effort::polish ? 200 : 10000;
  options.max_num_consecutive_invalid_steps = 50;
  options.logging_type = ceres::SILENT;
  return options;
}

/// Ceres says on the standard error stream what the summary says too.
void silence_log() { FLAGS_minloglevel = google::GLOG_FATAL; }

}  // namespace

Minimum minimise(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                 const RowTransform& transform, Effort effort) {
  silence_log();
  DenseCost cost(problem, transform);
  Minimum best{start, std::numeric_limits<double>::infinity()};
  for (const double radius : {1e4, 10.0, 1e-3}) {
    Eigen::VectorXd z = cost.unconstrained(start);
    if (!z.allFinite() || !cost.possible(z)) break;  // Ceres would complain on the standard error stream
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem minimisation(ownership);
    minimisation.AddResidualBlock(&cost, nullptr, z.data());
    ceres::Solver::Summary summary;
    ceres::Solve(solver_options(effort, radius), &minimisation, &summary);
    if (summary.termination_type != ceres::FAILURE && summary.final_cost < best.cost)
      best = {cost.physical(z.data()), summary.final_cost};
    if (effort != Effort::thorough) break;
  }
  return best;
}

namespace {

/// Ends the search after a number of steps that were taken or failed, or where the problem has had enough.
class EnoughSteps : public ceres::IterationCallback {
 public:
  explicit EnoughSteps(const SteppedProblem& problem) : problem_(problem), left_(problem.max_steps) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.iteration == 0) return ceres::SOLVER_CONTINUE;
    if (summary.step_is_successful)
      --left_, rejected_ = 0;
    else
      ++rejected_;
    const bool enough =
        left_ <= 0 || rejected() || (summary.step_is_successful && problem_.enough && problem_.enough());
    return enough ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  bool rejected() const { return rejected_ >= problem_.most_rejected; }

 private:
  const SteppedProblem& problem_;
  int left_, rejected_ = 0;
};

}  // namespace

SteppedMinimum minimise_stepped(const SteppedProblem& problem, const Eigen::VectorXd& start) {
  silence_log();
  SteppedMinimum best{start};
  SteppedCost cost(problem, start.size());
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem minimisation(ownership);
  minimisation.AddResidualBlock(&cost, nullptr, best.u.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.initial_trust_region_radius = problem.initial_radius;
  options.function_tolerance = problem.tolerance;
  options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.max_num_iterations = problem.max_steps * (1 + problem.most_rejected);
  options.max_num_consecutive_invalid_steps = problem.most_rejected + 1;  // which end it before
  options.logging_type = ceres::SILENT;
  EnoughSteps enough(problem);
  options.callbacks.push_back(&enough);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &minimisation, &summary);
  best.cost = summary.final_cost;
  best.steps = static_cast<int>(summary.iterations.size()) - 1;
  best.ok = summary.termination_type != ceres::FAILURE;
  best.rejected = enough.rejected();
  return best;
}

}  // namespace ident
