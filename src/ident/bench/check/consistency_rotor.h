// Do thrust and torque constant belong to a propeller of that size?
//
//   figure of merit = T^1.5/sqrt(2 rho A)/(Q Omega) = kT^1.5/(kQ sqrt(2 rho A)) < 1   momentum theory (1)
#pragma once

#include "ident/bench/check/consistency.h"

namespace ident {

void check_rotor(const Vehicle& vehicle, Consistency& found);  ///< kQ/kT, figure of merit, tip speed, overlap

}  // namespace ident
