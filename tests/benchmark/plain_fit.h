// The refinement as anyone would write it with Ceres: one residual block a segment, derivatives by Ceres' own
// dual numbers through the same templated model, the segments' states eliminated by Ceres' Schur complement.
#pragma once

#include <Eigen/Core>

#include "ident/flight/record/flight_record.h"
#include "ident/flight/smoother/parameterisation.h"

namespace ident {

/// Constants that the benchmark frees, and a segment's state: rates, attitude, velocity, position, motors.
constexpr int kPlainShared = 10, kPlainState = 20;

struct PlainFit {
  Eigen::VectorXd u;  ///< of the constants, as in Theta
  double cost = 0.0;  ///< sum of squares, priors included
  int iterations = 0;
  double seconds = 0.0, jacobian_seconds = 0.0, linear_seconds = 0.0;
};

/// Segments of `seconds` with free states, unlinked, squares without a robust shape.
PlainFit fit_plainly(const FlightRecord& record, const Theta& theta, double seconds, double tolerance,
                     int threads);

}  // namespace ident
