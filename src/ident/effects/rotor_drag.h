// Rotor drag: each rotor resists the air that crosses its disk, in proportion to its speed.
//
//   F_i = -kd Omega_i v_perp   at each hub
//
// Assumption: blade drag and flapping tilt lumped into one coefficient, as in the usual H-force model.
// Looks like: Fx and Fy odd in velocity, growing with rotor speed; moments by the height of the hubs.
// Confused with: parasitic_drag, wind, blade_flapping.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct RotorDrag {
  static constexpr EffectInfo info{
      .name = "rotor_drag",
      .touches = kTouchFlow | kTouchRotor | kTouchHub,
      .equation = "F_i = -kd Omega_i v_perp   at each hub",
      .looks_like = "Fx and Fy odd in velocity, growing with rotor speed; moments by the height of the hubs",
      .confused_with = "parasitic_drag, wind, blade_flapping",
      .split_by =
          "fly one speed at two collectives (level and climbing): rotor drag grows with rotor speed, body "
          "drag does not"};
  static constexpr std::array parameters{EffectParameter{"kd", "kg/rad", 0.0, Range::positive, 1e-05, 0.001}};

  template <class S>
  static void apply(const S* p, RotorSeam<S>& seam) {
    seam.F_B -= (p[0] * seam.Omega) * seam.across();
  }
};

}  // namespace ident
