// The stated vehicle with what a diagnosis identified, and nothing else of it.
#pragma once

#include "ident/gap/diagnose.h"

namespace ident {

/// Constants and effects that the flights determine, by themselves or together, have the values found. What
/// they do not determine keeps what was stated of it.
Vehicle identified_vehicle(const Vehicle& stated, const Diagnosis& diagnosis);

}  // namespace ident
