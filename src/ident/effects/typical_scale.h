// The typical size of a constant, as a unit step where its value may be zero.
#pragma once

#include <vector>

#include "ident/model/vehicle.h"

namespace ident {

/// Unit step of a constant: its typical size where its value may be zero.
double typical_scale(int index, const Vehicle& vehicle, const std::vector<double>& p);

}  // namespace ident
