// Can the vehicle hover: enough thrust, a command within its range, and a trim that balances all moments?
//
//   thrust to weight = sum_n T_n(delta = 1) (-a_n,z)/(m g) ,  T_n = kT (Omega_0 + km)^2 (1) trim:  T of least
//   norm with  sum_n wrench_n T_n = (0, -m g) in (Mx, My, Mz; Fz)                          (2) hover speed
//   sqrt(T_n/kT), hover command (Omega - Omega_0)/km of the rotor that works hardest             (3)
#pragma once

#include "ident/bench/check/consistency.h"

namespace ident {

void check_hover(const Vehicle& vehicle, Consistency& found);  ///< thrust to weight, hover command, trim

}  // namespace ident
