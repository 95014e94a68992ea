// How far a model is trusted in a window of flight: its errors grow with speed as its residuals show.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/flight/ladder/measured_motion.h"

namespace ident {

/// Weights of residuals, as many components a window each: the inverse of a variance a + b v^2 that is fitted
/// to them, less for those of windows that stand out (Huber).
Eigen::VectorXd weight_by_speed(const std::vector<Window>& windows, const Eigen::VectorXd& residual);

}  // namespace ident
