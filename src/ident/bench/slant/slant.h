// The slant angle that decouples a quadrotor whose rotors all turn the same way, and what it costs.
#pragma once

#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

/// `alpha_opt` with its uncertainty, the allocation of the four inputs at that angle, the best angle for the
/// vehicle as it is, and the price in lift, yaw and precision. Throws InputError where kT, kQ or the arm is
/// missing.
Result estimate_slant(const Vehicle& vehicle);

}  // namespace ident
