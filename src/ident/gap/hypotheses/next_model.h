// Fits of the next model that a search tries.
#pragma once

#include "ident/gap/hypotheses/fitted_model.h"
#include "ident/gap/hypotheses/screen.h"

namespace ident {

/// Where a search stands: the model so far, every cause linearised there, and which of them the model has.
struct Standing {
  FittedModel model;
  ExtendedProblem problem;
  QuadraticForm form;
  std::vector<int> have;
};

/// Linearises every cause but those of `exclude` at a fitted model.
Standing standing_at(const FlightRecord& record, const Vehicle& vehicle,
                     const std::vector<std::string>& exclude, FittedModel model);

/// The same cause, of the same rotor.
bool same(const Candidate& a, const Candidate& b);

/// Where the candidates of a problem have those causes.
std::vector<int> places_of(const std::vector<Candidate>& causes, const ExtendedProblem& problem);

/// The model with these causes, of the problem's candidates: constants that it has at their fitted values,
/// new ones at the step of the quadratic form, those of a cause that is left out at what they are without it.
FittedModel with_causes(const FlightRecord& record, const Vehicle& vehicle, const Standing& at_now,
                        const std::vector<int>& causes, const FlightFitOptions& options);

/// The model as it is with the motors' lag where it was stated; its constants keep the priors that were
/// stated.
FittedModel with_lag_held(const std::vector<FreeConstant>& base, const FlightRecord& record,
                          const std::vector<double>& p, const FlightFitOptions& options);

}  // namespace ident
