// What a diagnosis owes to measured rotor speeds as its input: their noise cannot be taken off without taking
// some of the motion.
#pragma once

#include <string>

#include "ident/gap/fitted_model.h"

namespace ident {

/// The cause found whose size depends on how the speeds were smoothed; `moved` is how far the unknowns move
/// with the other smoothing. Empty where there is none.
std::string depends_on_smoothing(const FittedModel& model, const Eigen::VectorXd& moved);

}  // namespace ident
