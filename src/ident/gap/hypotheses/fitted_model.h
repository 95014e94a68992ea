// The model with the causes taken up so far, fitted to the logs.
#pragma once

#include <memory>

#include "ident/flight/fit/fit.h"
#include "ident/gap/hypotheses/candidates.h"

namespace ident {

/// A model with causes adopted, fitted.
struct FittedModel {
  std::vector<FreeConstant> constants;  ///< base, then those of adopted effects; priors as originally stated
  std::vector<Candidate> adopted;
  std::shared_ptr<Theta> theta;  ///< what was fitted: priors of adopted parameters dropped
  FlightFit fit;
};

/// `constants` with those of adopted effects, at their starting values; a wrong parameter among `adopted` is
/// freed of what is stated of it.
FittedModel fitted(std::vector<FreeConstant> constants, std::vector<Candidate> adopted,
                   const FlightRecord& record, const std::vector<double>& p, const FlightFitOptions& options);

/// Whether it could be simulated to the end and left a covariance, with effects of sizes that are possible.
bool stands(const FittedModel& model);

/// The vehicle with the constants and effects of that fit, and their deviations.
Vehicle adopted_vehicle(const Vehicle& vehicle, const FittedModel& model);

}  // namespace ident
