// Fits of the next model that a search tries.
#pragma once

#include "ident/gap/fitted_model.h"
#include "ident/gap/screen.h"

namespace ident {

/// Where a search stands: the model so far and every cause linearised there.
struct Standing {
  const FittedModel& model;
  const ExtendedProblem& problem;
  const QuadraticForm& form;
};

/// The model with one more cause, `chosen` of the problem's candidates (`have` are those it has): its
/// constants at their fitted values, the new ones at the step of the quadratic form.
FittedModel with_cause(const FlightRecord& record, const Vehicle& vehicle, const Standing& at_now,
                       const std::vector<int>& have, int chosen, const FlightFitOptions& options);

/// The model as it is with the motors' lag where it was stated; its constants keep the priors that were
/// stated.
FittedModel with_lag_held(const std::vector<FreeConstant>& base, const FlightRecord& record,
                          const std::vector<double>& p, const FlightFitOptions& options);

}  // namespace ident
