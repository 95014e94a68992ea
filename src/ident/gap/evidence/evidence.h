// What convinces an engineer besides numbers: signatures of the causes, held-out flight before and after.
#pragma once

#include "ident/flight/fit/prediction.h"
#include "ident/gap/evidence/signature.h"
#include "ident/result/shown.h"

namespace ident {

struct GapEvidence {
  std::vector<Plot> held_out;  ///< predictions over 0.5 and 1 s in the channels where the causes gain most,
                               ///< where pictures are shown
  std::vector<Signature> signatures;
};

/// The flight on which the models are judged: unknowns of the base model as given and of the model found, and
/// their errors over the longest horizon.
struct HeldOutFlight {
  const FlightRecord& record;
  const Eigen::VectorXd &as_given, &found;
  const NoiseModel& noise;
  const std::vector<PredictionWindow>&errors_before, &errors_after;
};

GapEvidence evidence_of(const FlightRecord& record, const SearchResult& search, const HeldOutFlight& held_out,
                        Shown shown);

}  // namespace ident
