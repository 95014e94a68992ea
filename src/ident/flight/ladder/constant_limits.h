// How far a constant of a vehicle can be from what was stated of it.
#pragma once

#include <array>

#include "ident/flight/smoother/parameterisation.h"

namespace ident {

/// Lowest and highest unknown of a constant (Theta's coordinate). Effects keep to their physical sign and
/// size; a mass to five of the deviations with which it was weighed; other constants to a factor.
std::array<double, 2> limits_of(const FreeConstant& constant);

/// Standard deviation of the unknown where nothing was stated: as far as `limits_of` goes.
double spread_without_prior(const FreeConstant& constant);

}  // namespace ident
