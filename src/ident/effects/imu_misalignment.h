// Misalignment of the IMU against the body axes.
//
//   shown = v - e x v + e x (e x v)/2   for rates and specific force
//
// The IMU is turned by the small rotation vector e against the body; second order in the angle.
// Looks like: part of one axis appears on another, in rates and specific force alike.
// Confused with: products_of_inertia, rotor_tilt, imu_bias.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct ImuMisalignment {
  static constexpr EffectInfo info{
      .name = "imu_misalignment",
      .touches = kTouchImuFrame,
      .equation = "shown = v - e x v + e x (e x v)/2   for rates and specific force",
      .looks_like = "part of one axis appears on another, in rates and specific force alike",
      .confused_with = "products_of_inertia, rotor_tilt, imu_bias",
      .split_by = "a six-position test on the bench"};
  static constexpr std::array parameters{EffectParameter{"x", "rad", 0.0, Range::any, 0.02, 0.35},
                                         EffectParameter{"y", "rad", 0.0, Range::any, 0.02, 0.35},
                                         EffectParameter{"z", "rad", 0.0, Range::any, 0.02, 0.35}};

  template <class S>
  static void apply(const S* p, SensorSeam<S>& seam) {
    const Vec3<S> e(p[0], p[1], p[2]);
    const Vec3<S> f = cross(e, seam.f_B), w = cross(e, seam.gyro);
    seam.f_B += 0.5 * cross(e, f) - f;
    seam.gyro += 0.5 * cross(e, w) - w;
  }
};

}  // namespace ident
