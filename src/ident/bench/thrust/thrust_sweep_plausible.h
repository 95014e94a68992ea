// Constants that no propeller has: wrong units, swapped columns.
#pragma once

#include "ident/bench/thrust/thrust_sweep.h"
#include "ident/result/result.h"

namespace ident {

/// Warnings `not_identifiable`, `implausible_torque_ratio`, `implausible_thrust` on what the sweeps gave.
void warn_of_implausible(Result& result, const ThrustOptions& options);

}  // namespace ident
