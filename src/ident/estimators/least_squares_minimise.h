// The minimiser behind the door: one start to one minimum, in unconstrained coordinates.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "ident/estimators/least_squares.h"

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

Minimum minimise(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                 const RowTransform& transform, Effort effort);

}  // namespace ident
