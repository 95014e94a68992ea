// How much a rotor's rate walks, from the samples of its speed alone.
#pragma once

#include <vector>

#include "ident/estimators/flight_speed_walk.h"

namespace ident {

/// The intensity from each row's predecessor to it, in units of the noise's variance over s^3: high where the
/// motor is driven hard, low where it hovers. Empty where the samples leave no noise to be seen.
std::vector<double> likely_intensities(const SpeedSamples& samples);

}  // namespace ident
