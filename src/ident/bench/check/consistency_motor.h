// Do the constants of a DC motor belong together?
//
// In SI units the torque constant ki and the back-EMF constant kv are the same number but for losses and the
// shape of the windings' field: P_air gap = ki I Omega = kv Omega I.
#pragma once

#include "ident/bench/check/consistency.h"

namespace ident {

void check_motor(const Vehicle& vehicle, Consistency& found);  ///< DC motor constants, dynamics

}  // namespace ident
