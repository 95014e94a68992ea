// Lever arm of the accelerometer from the origin.
//
//   f_shown = f + w' x r + w x (w x r)
//
// Rates are the same everywhere on a rigid body.
// Looks like: specific force with angular acceleration and squared rates.
// Confused with: cg_offset, blade_flapping, imu_misalignment.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct ImuLeverArm {
  static constexpr EffectInfo info{.name = "imu_lever_arm",
                                   .touches = 0,
                                   .equation = "f_shown = f + w' x r + w x (w x r)",
                                   .looks_like = "specific force with angular acceleration and squared rates",
                                   .confused_with = "cg_offset, blade_flapping, imu_misalignment",
                                   .split_by = "shake about one axis at a time"};
  static constexpr std::array parameters{EffectParameter{"x", "m", 0.0, Range::any, 0.005, 0.15},
                                         EffectParameter{"y", "m", 0.0, Range::any, 0.005, 0.15},
                                         EffectParameter{"z", "m", 0.0, Range::any, 0.005, 0.15}};

  template <class S>
  static void apply(const S* p, SensorSeam<S>& seam) {
    const Vec3<S> r(p[0], p[1], p[2]);
    seam.f_B += cross(seam.w_dot_B, r) + cross(seam.w_B, cross(seam.w_B, r));
  }
};

}  // namespace ident
