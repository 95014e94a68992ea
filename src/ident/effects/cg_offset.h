// Offset of the centre of gravity from the origin of the vehicle file.
//
//   M = -c x F, and the sensors sit at -c
//
// Inertia stays that about the centre of gravity.
// Looks like: moments that grow with total thrust.
// Confused with: rotor_mismatch, rotor_tilt, payload, wind.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct CgOffset {
  static constexpr EffectInfo info{
      .name = "cg_offset",
      .touches = kTouchCentre,
      .equation = "M = -c x F, and the sensors sit at -c",
      .looks_like = "moments that grow with total thrust",
      .confused_with = "rotor_mismatch, rotor_tilt, payload, wind",
      .split_by = "strong doublets at constant collective; balance the vehicle on a knife edge"};
  static constexpr std::array parameters{EffectParameter{"x", "m", 0.0, Range::any, 0.002, 0.03},
                                         EffectParameter{"y", "m", 0.0, Range::any, 0.002, 0.03},
                                         EffectParameter{"z", "m", 0.0, Range::any, 0.005, 0.06}};

  template <class S>
  static void apply(const S* p, MassSeam<S>& seam) {
    for (int i = 0; i < 3; ++i) seam.c_B[i] += p[i];
  }
};

}  // namespace ident
