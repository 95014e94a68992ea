// The motor fit as a least squares problem: unknowns, equations and starts for one static curve.
#pragma once

#include <vector>

#include "ident/bench/motor/motor_step_fit.h"
#include "ident/lsq/least_squares.h"

namespace ident {

/// Unknowns in the order: coefficients of the static curve, shape, speed and rate at the start of each
/// record. The records have to outlive it.
class MotorProblem {
 public:
  MotorProblem(const std::vector<StepRecord>& records, StaticCurve curve, SpinDirections directions,
               DeadTime dead_time = DeadTime::free);

  /// Start with that shape: everything else is linear.
  struct Start {
    Eigen::VectorXd x;
    Eigen::VectorXd residuals;  ///< model minus measurement, rad/s
  };
  Start start(const MotorShape& shape) const;

  MotorFit solve(const std::vector<Eigen::VectorXd>& starts,
                 const LeastSquaresOptions& options = {.search_widely = false}) const;

 private:
  Eigen::Index shape_at() const { return coefficients_; }
  Eigen::Index shape_size() const { return directions_ == SpinDirections::apart ? 4 : 3; }
  Eigen::Index start_at(std::size_t record) const {
    return shape_at() + shape_size() + 2 * static_cast<Eigen::Index>(record);
  }
  Eigen::Index unknowns() const { return start_at(records_.size()); }
  MotorShape shape(const Eigen::VectorXd& x) const;
  std::string name(Eigen::Index unknown) const;
  /// The model's speeds; the Jacobian when it is not null.
  void predict(const Eigen::VectorXd& x, Eigen::VectorXd& Omega, Eigen::MatrixXd* J) const;
  LeastSquaresProblem problem(const std::vector<Eigen::VectorXd>& starts) const;

  const std::vector<StepRecord>& records_;
  StaticCurve curve_;
  SpinDirections directions_;
  DeadTime dead_time_;
  Eigen::Index coefficients_ = 0, samples_ = 0;
  std::vector<Eigen::MatrixXd> inputs_;
  std::vector<Eigen::Index> first_coefficient_;
  Eigen::VectorXd measured_;
};

}  // namespace ident
