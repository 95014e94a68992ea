// Ground effect: near the ground a rotor lifts more at the same speed.
//
//   T/T_inf = 1/(1 - radius_sq/(16 z^2))
//
// [Cheeseman and Bennett 1955] with the effective radius; radius_sq = radius^2 so that it is of first order
// at zero. The file and the report speak of radius; close to touch-down the factor is held at 4/3. Looks
// like: Fz depends on height alone, below a few rotor radii. Confused with: translational_lift, parameter:kT,
// thrust_curve.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct GroundEffect {
  static constexpr EffectInfo info{.name = "ground_effect",
                                   .touches = kTouchRotor | kTouchHeight,
                                   .equation = "T/T_inf = 1/(1 - radius_sq/(16 z^2))",
                                   .looks_like = "Fz depends on height alone, below a few rotor radii",
                                   .confused_with = "translational_lift, parameter:kT, thrust_curve",
                                   .split_by = "hover steps at 0.5, 1, 2, 4 and 8 rotor radii"};
  static constexpr std::array parameters{
      EffectParameter{"radius_sq", "m^2", 0.0, Range::positive, 0.01, 0.25}};

  template <class S>
  static void apply(const S* p, RotorSeam<S>& seam) {
    using std::sqrt;
    // Height kept positive and smooth at touch-down: about max(z, 0).
    const S z = 0.5 * (seam.height + sqrt(seam.height * seam.height + 1e-4));
    const S ratio = p[0] / (16.0 * z * z + 1e-9);
    // ratio/(1 + (4 ratio)^4)^(1/4) is the ratio below 1/4 and at most 1/4.
    const S r4 = 4.0 * ratio;
    const S r4_2 = r4 * r4;
    seam.T = seam.T / (1.0 - ratio / sqrt(sqrt(1.0 + r4_2 * r4_2)));
  }
};

}  // namespace ident
