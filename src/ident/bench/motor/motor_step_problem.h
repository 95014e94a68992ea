// The motor fit as a least squares problem: unknowns, equations and starts for one static curve.
#pragma once

#include <vector>

#include "ident/bench/motor/motor_step_fit.h"
#include "ident/lsq/least_squares.h"

namespace ident {

/// What is free in a problem.
struct MotorFreedom {
  StaticCurve curve = StaticCurve::proportional;
  SpinDirections directions = SpinDirections::alike;
  DeadTime dead_time = DeadTime::free;
  double edge_scatter = 0.0;  ///< s, standard deviation of the edges' own dead times; 0: one for all
};

/// Unknowns in the order: coefficients of the static curve, shape, speed and rate at the start of each
/// record, shifts of the edges. The records have to outlive it.
class MotorProblem {
 public:
  /// `left_out`: rows that do not count; `suspects`: rows that may not, for a robust fit; empty: none.
  MotorProblem(const std::vector<StepRecord>& records, const MotorFreedom& freedom,
               const std::vector<bool>& left_out = {}, const std::vector<bool>& suspects = {});

  /// Start with that shape and, where edges are free, those shifts: everything else is linear.
  struct Start {
    Eigen::VectorXd x;
    Eigen::VectorXd residuals;  ///< model minus measurement, rad/s, 0 in rows that are left out
  };
  Start start(const MotorShape& shape, const std::vector<double>& shifts = {}) const;

  /// sum of r_i^2 J_i J_i' over the rows, J by the physical unknowns.
  Eigen::MatrixXd squares(const Eigen::VectorXd& x) const;

  MotorFit solve(const std::vector<Eigen::VectorXd>& starts,
                 const LeastSquaresOptions& options = {.search_widely = false}) const;

 private:
  Eigen::Index shape_at() const { return coefficients_; }
  Eigen::Index shape_size() const { return freedom_.directions == SpinDirections::apart ? 4 : 3; }
  Eigen::Index start_at(std::size_t record) const {
    return shape_at() + shape_size() + 2 * static_cast<Eigen::Index>(record);
  }
  Eigen::Index shift_at(std::size_t record) const { return start_at(records_.size()) + first_shift_[record]; }
  Eigen::Index shifts() const { return freedom_.edge_scatter > 0.0 ? steps_ : 0; }
  Eigen::Index unknowns() const { return start_at(records_.size()) + shifts(); }
  MotorShape shape(const Eigen::VectorXd& x) const;
  /// A record with its edges where x says that they are.
  StepRecord moved(const Eigen::VectorXd& x, std::size_t record) const;
  std::string name(Eigen::Index unknown) const;
  /// The model's speeds; the Jacobian when it is not null.
  void predict(const Eigen::VectorXd& x, Eigen::VectorXd& Omega, Eigen::MatrixXd* J) const;
  LeastSquaresProblem problem(const std::vector<Eigen::VectorXd>& starts) const;

  const std::vector<StepRecord>& records_;
  MotorFreedom freedom_;
  Eigen::Index coefficients_ = 0, samples_ = 0, steps_ = 0;
  std::vector<bool> suspects_;
  Eigen::VectorXd weights_;  ///< of the rows, 1 or 0
  std::vector<Eigen::MatrixXd> inputs_;
  std::vector<Eigen::Index> first_coefficient_, first_shift_;
  Eigen::VectorXd measured_;
};

}  // namespace ident
