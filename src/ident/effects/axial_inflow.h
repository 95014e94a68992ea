// Axial inflow: a rotor that moves along its axis lifts less, in proportion to its speed.
//
//   T_i -= kz Omega_i v_par
//
// Assumption: first order of momentum and blade-element theory about hover.
// Looks like: Fz with climb rate; damping of roll and pitch rates.
// Confused with: motor lag (parameter:omega_m), blade_flapping, rate damping.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct AxialInflow {
  static constexpr EffectInfo info{
      .name = "axial_inflow",
      .touches = kTouchFlow | kTouchRotor,
      .equation = "T_i -= kz Omega_i v_par",
      .looks_like = "Fz with climb rate; damping of roll and pitch rates",
      .confused_with = "motor lag (parameter:omega_m), blade_flapping, rate damping",
      .split_by = "level vertical steps (inflow) and a frequency sweep in roll (lag)"};
  static constexpr std::array parameters{EffectParameter{"kz", "kg/rad", 0.0, Range::positive, 1e-05, 0.003}};

  template <class S>
  static void apply(const S* p, RotorSeam<S>& seam) {
    seam.T -= p[0] * (seam.Omega * seam.along());
  }
};

}  // namespace ident
