// What a model misses over windows of measured flight, its forces and its moments apart.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/flight/ladder/measured_motion.h"
#include "ident/flight/ladder/model_along.h"

namespace ident {

/// Which side of (1) in window_fit.h is looked at.
enum class FitTo { forces, moments };

/// Windows over which that side is compared: long enough that what filters of a log's makers take away does
/// not matter, short enough that little is turned back within one.
std::vector<Window> windows_of(const MeasuredMotion& motion, FitTo what);

/// Length of those windows, s.
double horizon_of(FitTo what);

/// What was measured beyond what the model gives, three components a window: m/s in the world, or rad/s of
/// the body.
Eigen::VectorXd missed_in(const MeasuredMotion& motion, const std::vector<Window>& windows, FitTo what,
                          const std::vector<ModelAlong>& model);

}  // namespace ident
