// A found model with some of its causes only, to tell how far these close the gap.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/flight/fit/prediction.h"
#include "ident/gap/hypotheses/fitted_model.h"

namespace ident {

/// The constants `u` of a model with these of its causes only, all else as it is; wind with the drag through
/// which it acts.
Eigen::VectorXd with_only(const FittedModel& model, const Eigen::VectorXd& u,
                          const std::vector<Candidate>& causes);

/// Those of `all` that begin where one of `some` does, both in order.
std::vector<PredictionWindow> same_windows(const std::vector<PredictionWindow>& all,
                                           const std::vector<PredictionWindow>& some);

}  // namespace ident
