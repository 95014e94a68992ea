// Translational lift: a rotor that moves across its disk lifts more.
//
//   T_i += kh v_perp^2   along a_i
//
// Assumption: second order in the speed across the disk, independent of rotor speed.
// Looks like: Fz even in horizontal speed.
// Confused with: parameter:kT, thrust_curve, axial_inflow.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct TranslationalLift {
  static constexpr EffectInfo info{.name = "translational_lift",
                                   .touches = kTouchFlow | kTouchRotor,
                                   .equation = "T_i += kh v_perp^2   along a_i",
                                   .looks_like = "Fz even in horizontal speed",
                                   .confused_with = "parameter:kT, thrust_curve, axial_inflow",
                                   .split_by = "fast level legs to and fro at constant height"};
  static constexpr std::array parameters{EffectParameter{"kh", "kg/m", 0.0, Range::positive, 0.001, 0.05}};

  template <class S>
  static void apply(const S* p, RotorSeam<S>& seam) {
    const S along = seam.along();
    seam.T += p[0] * (dot(seam.v_air_B, seam.v_air_B) - along * along);
  }
};

}  // namespace ident
