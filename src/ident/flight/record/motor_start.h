// Motors where an arc begins, by the commands before it.
#pragma once

#include <array>
#include <cstddef>

#include "ident/effects/catalogue.h"
#include "ident/model/flight.h"

namespace ident {

/// At time `t`, s, as the commands of the 0.3 s before leave them. Before the first command that one holds.
/// The inputs of `flight` are commands.
std::array<MotorState<double>, kMaxRotors> motors_at_start(Flight<double, EffectSet<double>>& flight,
                                                           double t, std::size_t rotors);

}  // namespace ident
