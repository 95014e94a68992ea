// Does the slant of a quadrotor with four equal propellers balance their torque?
#pragma once

#include "ident/bench/check/consistency.h"

namespace ident {

void check_slant(const Vehicle& vehicle, Consistency& found);  ///< mounted against decoupling angle

}  // namespace ident
