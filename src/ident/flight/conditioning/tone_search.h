// Whether an inertial sensor feels the rotors turn, and how fast they do.
#pragma once

#include <vector>

#include "ident/flight/conditioning/rotor_tones.h"

namespace ident {

/// Multiples of the rotors' turns whose tones stand out of what is beside them, and of what rotors that do as
/// they are told would make there (`commanded`: commanded_in()): a controller that oscillates makes lines
/// too.
struct TonesFound {
  std::vector<int> beyond_doubt, likely;  ///< the latter where another one is beyond doubt
  bool passed_on = false;                 ///< commands have such a tone too
};
TonesFound tones_that_stand_out(const TurningRotors& rotors, const ToneWindows& sensor,
                                const std::vector<Eigen::MatrixXd>& commanded, double scale);

/// By how much rotors turn faster than `rotors` has them, where the most power of all sensors lies at
/// multiples of their turns: for speeds that are only simulated. NaN where that grows towards what they
/// cannot be off by: what is there is no tone of theirs.
double likeliest_scale(const TurningRotors& rotors, const std::vector<const ToneWindows*>& sensors);

}  // namespace ident
