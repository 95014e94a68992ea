// Constants that no propeller has: wrong units, swapped columns.
#pragma once

#include "ident/core/result.h"
#include "ident/estimators/thrust_sweep.h"

namespace ident {

/// Warnings `not_identifiable`, `implausible_torque_ratio`, `implausible_thrust` on what the sweeps gave.
void warn_of_implausible(Result& result, const ThrustOptions& options);

}  // namespace ident
