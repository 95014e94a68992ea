// The stated vehicle with what a diagnosis identified, and nothing else of it.
#pragma once

#include "ident/gap/diagnose.h"

namespace ident {

/// Effects that were identified or named have the values found, and so have constants of which the flights
/// tell something, be it with others only (kT km^2): directions that they do not determine stayed at what was
/// stated. All else is as stated; everything, where the flights identify nothing at all.
Vehicle identified_vehicle(const Vehicle& stated, const Diagnosis& diagnosis);

}  // namespace ident
