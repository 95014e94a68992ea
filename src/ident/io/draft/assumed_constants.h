// Constants of a vehicle that nobody measured, guessed from its size, each as wide as the guess is.
#pragma once

#include <string>

#include "ident/io/draft/carried_weight.h"

namespace ident {

/// Lines of `parameters:` in a vehicle file, each marked ASSUMED. `carried`: at which commands and speeds the
/// log shows the vehicle to carry its weight.
std::string assumed_constants(double mass, double arm, int rotors, const CarriedWeight& carried);

}  // namespace ident
