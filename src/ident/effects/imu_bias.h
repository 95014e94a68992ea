// Bias of the accelerometer.
//
//   f_shown = f + b
//
// Constant over a log. A small gyro bias is a free nuisance of every log.
// Looks like: a constant specific force without a twin in the motion.
// Confused with: wind, rotor_tilt.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct ImuBias {
  static constexpr EffectInfo info{
      .name = "imu_bias",
      .touches = 0,
      .equation = "f_shown = f + b",
      .looks_like = "a constant specific force without a twin in the motion",
      .confused_with = "wind, rotor_tilt",
      .split_by = "a slow turn through 360 degrees, or a six-position test on the bench"};
  static constexpr std::array parameters{EffectParameter{"ax", "m/s^2", 0.0, Range::any, 0.1, 1.5},
                                         EffectParameter{"ay", "m/s^2", 0.0, Range::any, 0.1, 1.5},
                                         EffectParameter{"az", "m/s^2", 0.0, Range::any, 0.1, 1.5}};

  template <class S>
  static void apply(const S* p, SensorSeam<S>& seam) {
    for (int i = 0; i < 3; ++i) seam.f_B[i] += p[i];
  }
};

}  // namespace ident
