// Which of two diagnoses is given: that along measured motion, or that by a model of the whole flight.
#pragma once

#include "ident/gap/diagnose_windows.h"

namespace ident {

/// Whether a diagnosis along measured motion stands against one by a model of the whole flight (constants by
/// the first part of the flight), by how both predict velocity on the rest, with attitude and rates as
/// measured. It names a cause that the other does not, and the other predicts worse beyond chance by a
/// material part of the gap; or no better, and is not sure.
bool stands_against(const WindowDiagnosis& windows, const FlightRecord& record,
                    const std::vector<double>& whole, const Judged& verdict);

}  // namespace ident
