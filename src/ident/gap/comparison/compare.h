// What differs between a real vehicle and its simulation: both logs are diagnosed against one vehicle file,
// and the difference of the two is the answer.
#pragma once

#include "ident/gap/diagnose.h"

namespace ident {

/// Real and simulated flights have commands and paths of their own. Schema ident.gap/1, with `differences`.
/// Throws DataError when one of the two sides allows no diagnosis.
Result compare_flights(const Vehicle& vehicle, std::span<const FlightLog> real,
                       std::span<const FlightLog> simulated, const GapOptions& options = {});

}  // namespace ident
