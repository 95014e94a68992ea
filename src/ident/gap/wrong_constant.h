// A constant stated with confidence and far from the truth bends all others before it moves: from there no
// small step shows what it hides.
#pragma once

#include "ident/gap/fitted_model.h"
#include "ident/gap/screen.h"

namespace ident {

/// A model with one stated constant freed, all others back at what was stated.
struct WrongConstant {
  int candidate = -1;  ///< of the problem
  FittedModel model;
  double gain = 0.0;    ///< fall of the cost, priors included, below that of the model at hand
  bool beyond = false;  ///< so far off what was stated that no physics that the model lacks explains it
};

/// Of the constants that the model at hand pulls far off their stated values, the one that gains most when it
/// alone is free to be anything; searched over a wide range of values. `p`: as stated, with adopted effects
/// at their found values. Candidate -1 where nothing is pulled so far, or nothing gains.
WrongConstant wrong_constant(const FlightRecord& record, const std::vector<double>& p,
                             const FittedModel& at_hand, const ExtendedProblem& problem,
                             const QuadraticForm& form, const FlightFitOptions& options);

}  // namespace ident
