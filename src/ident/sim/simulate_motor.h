// Rows of a step recording: the motor model between commands that hold.
#pragma once

#include "ident/sim/simulate_bench.h"

namespace ident {

/// t, delta or u, omega; a row's command holds from its time on. Throws UsageError as above.
NumberTable simulate_motor(const Vehicle& vehicle, const MotorSteps& options = {});

}  // namespace ident
