// Thrust curve: thrust per squared speed changes with speed.
//
//   T = kT Omega^2 (1 + c (Omega/Omega_hover - 1))
//
// Omega_hover is the nominal hover speed sqrt(m g/(N kT)); kT is then the value at hover.
// Looks like: Fz depends on collective.
// Confused with: parameter:kT, battery_sag, axial_inflow.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct ThrustCurve {
  static constexpr EffectInfo info{
      .name = "thrust_curve",
      .touches = kTouchRotor,
      .equation = "T = kT Omega^2 (1 + c (Omega/Omega_hover - 1))",
      .looks_like = "Fz depends on collective",
      .confused_with = "parameter:kT, battery_sag, axial_inflow",
      .split_by = "a thrust sweep on the bench, or vertical steps at different accelerations"};
  static constexpr std::array parameters{EffectParameter{"c", "-", 0.0, Range::any, 0.05, 0.4}};

  template <class S>
  static void apply(const S* p, RotorSeam<S>& seam) {
    seam.T = seam.T * (1.0 + p[0] * (seam.Omega * *seam.per_Omega_hover - 1.0));
  }
};

}  // namespace ident
