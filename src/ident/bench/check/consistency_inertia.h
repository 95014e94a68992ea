// Can a body have this inertia?
//
//   J = integral (r^2 I - r r^T) dm  <=>  S = tr(J)/2 I - J = integral r r^T dm is positive semi-definite (1)
//
// In principal axes (1) is the triangle inequality J1 + J2 >= J3: no moment exceeds the sum of the others.
#pragma once

#include "ident/bench/check/consistency.h"

namespace ident {

void check_inertia(const Vehicle& vehicle, Consistency& found);  ///< definite, triangle inequality, size

}  // namespace ident
