// The minimiser behind the door: one start to one minimum, in unconstrained coordinates.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "ident/lsq/least_squares.h"

namespace ident {

/// Changes residuals and, when it is not null, Jacobian in place: weights, decorrelation, robust shape.
using RowTransform = std::function<void(Eigen::VectorXd& r, Eigen::MatrixXd* J)>;

/// How hard to try: `coarse` ranks starts, `polish` continues from a good start to the last digit,
/// `thorough` keeps the best of three initial trust regions.
enum class Effort { coarse, polish, thorough };

struct Minimum {
  Eigen::VectorXd x;  ///< physical values
  double cost;        ///< half the sum of squares after the transform; infinite when the start is impossible
};

/// Residuals that keep a state of their own between steps (the flight smoother): evaluated once per step,
/// with J asked for again only where the step was accepted.
struct SteppedProblem {
  Eigen::Index residuals = 0;
  ResidualFunction evaluate;  ///< in unconstrained coordinates; `J` null for a trial step
  double tolerance = 1e-9;    ///< relative change of the cost
  int max_steps = 30;         ///< that are taken
  double initial_radius = 1e4;
  int most_rejected = 10;        ///< one after the other: the trust region shrinks meanwhile
  std::function<bool()> enough;  ///< asked after each step that was taken; may be empty
};

struct SteppedMinimum {
  Eigen::VectorXd u;
  double cost = 0.0;
  int steps = 0;
  bool ok = false;
  bool rejected = false;  ///< ended at steps that failed
};

Minimum minimise(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                 const RowTransform& transform, Effort effort);
SteppedMinimum minimise_stepped(const SteppedProblem& problem, const Eigen::VectorXd& start);

}  // namespace ident
