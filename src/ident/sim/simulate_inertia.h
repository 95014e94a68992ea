// Rows of a trifilar pendulum.
//
//   J = J_vehicle + J_platform + (m_v m_p/m) offset^2 ,   m = m_v + m_p
//   r^2 = radius^2 - c^2 ,   c = m_v offset/m
//
// about the common centre of gravity, with the exact period of model/trifilar_period.h; the inverse of what
// the file format states.
#pragma once

#include "ident/sim/simulate_bench.h"

namespace ident {

/// axis, period, mass, radius, length, offset and amplitude where they are not 0. The platform is a disc of
/// the wires' radius. Throws UsageError where the vehicle states no mass or inertia.
NumberTable simulate_inertia(const Vehicle& vehicle, const PendulumSwings& options = {});

}  // namespace ident
