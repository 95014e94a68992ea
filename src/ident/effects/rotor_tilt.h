// Rotor tilt: a thrust axis is turned by a few degrees about body x and y.
//
//   a -> a + e x a + e x (e x a)/2,   e = (x + x@k, y + y@k, 0)
//
// x and y hold for all rotors, x@k and y@k for rotor k; second order in the angle.
// Looks like: lateral force and Mz in step with the thrust of that rotor.
// Confused with: rotor_mismatch, cg_offset, imu_misalignment, parameter:kQ.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct RotorTilt {
  static constexpr EffectInfo info{
      .name = "rotor_tilt",
      .touches = kTouchRotor | kTouchAxis,
      .equation = "a -> a + e x a + e x (e x a)/2,   e = (x + x@k, y + y@k, 0)",
      .looks_like = "lateral force and Mz in step with the thrust of that rotor",
      .confused_with = "rotor_mismatch, cg_offset, imu_misalignment, parameter:kQ",
      .split_by = "a rotor multisine with measured speeds, or a level and a square"};
  static constexpr std::array parameters{EffectParameter{"x", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"y", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"x@1", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"y@1", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"x@2", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"y@2", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"x@3", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"y@3", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"x@4", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"y@4", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"x@5", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"y@5", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"x@6", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"y@6", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"x@7", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"y@7", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"x@8", "rad", 0.0, Range::any, 0.02, 0.3},
                                         EffectParameter{"y@8", "rad", 0.0, Range::any, 0.02, 0.3}};

  template <class S>
  static void apply(const S* p, RotorSeam<S>& seam) {
    const S x = p[0] + p[2 + 2 * seam.index], y = p[1] + p[3 + 2 * seam.index];
    const Vec3<S> e(x, y, S(0.0));
    const Vec3<S> turned = cross(e, seam.a_B);
    seam.a_B += turned + 0.5 * cross(e, turned);
  }
};

}  // namespace ident
