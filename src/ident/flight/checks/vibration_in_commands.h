// Vibration that the controller passes on to the motors.
#pragma once

#include "ident/flight/conditioning/rotor_vibration.h"
#include "ident/result/result.h"

namespace ident {

/// Where a controller answers to it, what rotors do as fast as they turn is taken out with it: what is known
/// of motors is not known then.
void doubt_passed_on(Result& result, const Vibration& vibration);

}  // namespace ident
