// How much a rotor's rate walks, from the samples of its speed alone.
#pragma once

#include <vector>

#include "ident/flight/conditioning/speed_walk.h"

namespace ident {

/// By row; both empty where the samples leave no noise to be seen.
struct SpeedIntensities {
  std::vector<double> q;      ///< from the row before to this one, in units of the noise's variance over s^3:
                              ///< high where the motor is driven hard, low where it hovers
  std::vector<double> noise;  ///< variance of a sample, (rad/s)^2; NaN where there is none
};

SpeedIntensities likely_intensities(const SpeedSamples& samples);

}  // namespace ident
