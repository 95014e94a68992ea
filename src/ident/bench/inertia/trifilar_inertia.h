// Moments of inertia from the periods of a trifilar pendulum, and of a propeller from its measures.
#pragma once

#include <vector>

#include "ident/data/table.h"
#include "ident/result/result.h"

namespace ident {

struct InertiaOptions {
  double gravity = 9.81;  ///< m/s^2
};

/// Jxx, Jyy, Jzz of the vehicle about its centre of gravity, as far as its axes were swung, with the empty
/// platform and the offset of the centre of gravity taken off.
///
/// Repeated rows tell the noise; a column `std` states it. Throws DataError when no row has a vehicle axis.
Result estimate_inertia(const std::vector<NumberTable>& tables, const InertiaOptions& options = {});

/// Inertia of a propeller about its shaft as a rectangular plate: Jp = m (chord^2 + length^2)/12. It has no
/// standard deviation, because the difference of a blade from a plate is not in these numbers.
Parameter propeller_inertia(double mass, double chord, double length);

}  // namespace ident
