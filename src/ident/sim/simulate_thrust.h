// Rows of a thrust sweep: rest, then set-points from the lowest command to the highest.
#pragma once

#include "ident/sim/simulate_bench.h"

namespace ident {

/// omega, thrust, torque (where the vehicle has kQ), delta or u, voltage and current. Throws UsageError where
/// the vehicle lacks what the test needs.
NumberTable simulate_thrust(const Vehicle& vehicle, const ThrustSweep& options = {});

}  // namespace ident
