// What a model says of the rotors along measured flight: the speeds that the commands alone give.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "ident/flight/ladder/measured_motion.h"

namespace ident {

using RotorSpeeds = std::array<double, kMaxRotors>;  ///< rad/s

/// [arc][row looked at]: NaN where a speed was not measured.
std::vector<std::vector<RotorSpeeds>> measured_speeds(const MeasuredMotion& motion);

/// [arc][row looked at]: speeds by the commands of the log from the beginning of each arc. Needs commands.
/// `p`: the model's constants.
std::vector<std::vector<RotorSpeeds>> speeds_along(const MeasuredMotion& motion, std::span<const double> p);

}  // namespace ident
