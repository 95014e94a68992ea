// A propeller that shakes the vehicle more than the others do.
#pragma once

#include "ident/flight/conditioning/rotor_vibration.h"
#include "ident/gap/verdict/verdict.h"

namespace ident {

/// A verdict of a flight with that vibration. A propeller out of balance is something else that is left;
/// what a damaged one does beside shaking competes with causes of single rotors, of which none is named.
Judged with_vibration(Judged verdict, const Vibration& vibration);

}  // namespace ident
