// A propeller that shakes the vehicle more than the others do.
#pragma once

#include "ident/flight/conditioning/rotor_vibration.h"
#include "ident/gap/verdict/verdict.h"

namespace ident {

/// A verdict of a flight with that vibration: `unknown` while a propeller is out of balance.
Judged with_vibration(Judged verdict, const Vibration& vibration);

}  // namespace ident
