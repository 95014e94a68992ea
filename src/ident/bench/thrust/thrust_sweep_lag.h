// Logs in which nothing is steady (ramps): the forces trail the speed by a first-order lag, which is found
// first.
#pragma once

#include <vector>

#include "ident/bench/thrust/thrust_sweep_points.h"
#include "ident/core/math.h"

namespace ident {

struct LaggedPoints {
  double lag = kNaN;  ///< time constant, s
  std::vector<SweepPoint> points;
};

/// Squared speed through a first-order lag, chosen for the least scatter of the force about a line over it;
/// then means over short stretches of time. Empty when there are too few rows.
LaggedPoints lagged_points(const SweepRows& rows, const std::vector<double>& y);

}  // namespace ident
