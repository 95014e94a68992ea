// Parasitic drag: the airframe resists the air with the square of its speed.
//
//   F = -C abs(v) v   on the body
//
// Assumption: the same area from every side. No body drags more than a plate across the wind with an edge as
// long as the vehicle (Hoerner: C_D = 1.2): C = 0.12 N s^2/m^2 for 0.4 m, 0.5 kg.
// Looks like: force against the velocity, with its square, independent of rotor speed; matters above 4 m/s.
// Confused with: rotor_drag, wind.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct ParasiticDrag {
  static constexpr EffectInfo info{
      .name = "parasitic_drag",
      .touches = kTouchFlow,
      .equation = "F = -C abs(v) v   on the body",
      .looks_like =
          "force against the velocity, with its square, independent of rotor speed; matters above 4 m/s",
      .confused_with = "rotor_drag, wind",
      .split_by = "fly one speed at two collectives, or twice the speed: body drag goes with the square"};
  static constexpr std::array parameters{
      EffectParameter{"C", "N s^2/m^2", 0.0, Range::positive, 0.005, 0.12}};

  template <class S>
  static void apply(const S* p, BodySeam<S>& seam) {
    seam.F_B -= (p[0] * norm(seam.v_air_B, 1e-3)) * seam.v_air_B;
  }
};

}  // namespace ident
