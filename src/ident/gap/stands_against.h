// Which of two diagnoses is given: that along measured motion, or that by a model of the whole flight.
#pragma once

#include "ident/flight/ladder/ladder.h"
#include "ident/gap/diagnose_windows.h"

namespace ident {

/// Whether a verdict names nothing that it is certain of, though something is there.
bool is_unsure(const Judged& verdict);

/// Whether a model predicts held-out velocity, attitude and rates as measured, worse beyond chance than
/// another. Both by constants of the first part of the flight; one that is not finite is worse.
bool predicts_worse(const FlightRecord& record, const std::vector<double>& p,
                    const std::vector<double>& than);

/// Whether a diagnosis along measured motion stands against one by a model of the whole flight (constants by
/// the first part of the flight), by how both predict velocity on the rest, with attitude and rates as
/// measured. It names a cause that the other does not, and the other predicts worse beyond chance by a
/// material part of the gap; or no better, and is not sure.
bool stands_against(const WindowDiagnosis& windows, const FlightRecord& record,
                    const std::vector<double>& whole, const Judged& verdict);

/// Whether a diagnosis by whole models is sure and predicts held-out velocity no worse, beyond chance, than
/// forces along the measured motion do in the plain models of the ladder: then these have nothing to add.
bool needs_no_windows(const LadderResult& ladder, const FlightRecord& record,
                      const std::vector<double>& whole, const Judged& verdict);

}  // namespace ident
