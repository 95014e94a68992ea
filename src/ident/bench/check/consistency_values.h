// Sign, range and standard deviation of every number in a vehicle file.
#pragma once

#include "ident/bench/check/consistency.h"

namespace ident {

void check_values(const Vehicle& vehicle, Consistency& found);  ///< sign, range, standard deviations

}  // namespace ident
