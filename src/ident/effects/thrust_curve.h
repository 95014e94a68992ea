// Thrust curve: thrust per squared speed changes with speed.
//
//   T = kT Omega^2 (1 + c (x - 1) + offset (x - 1)^2/(x^2 + 0.02)) ,   x = Omega/Omega_hover
//
// Omega_hover is the nominal hover speed sqrt(m g/(N kT)); kT is then the value at hover, and c its slope
// there. A thrust stand's T = a + b Omega + c Omega^2 is met to second order about hover, with `offset` =
// a over the thrust at hover, less c; the 0.02 keeps a rotor at rest without thrust.
//
// Looks like: Fz depends on collective.
// Confused with: parameter:kT, battery_sag, axial_inflow.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct ThrustCurve {
  static constexpr EffectInfo info{
      .name = "thrust_curve",
      .touches = kTouchRotor,
      .equation = "T = kT Omega^2 (1 + c (x - 1) + offset (x - 1)^2/(x^2 + 0.02)), x = Omega/Omega_hover",
      .looks_like = "Fz depends on collective",
      .confused_with = "parameter:kT, battery_sag, axial_inflow",
      .split_by = "a thrust sweep on the bench, or vertical steps at different accelerations"};
  static constexpr std::array parameters{EffectParameter{"c", "-", 0.0, Range::any, 0.05, 0.4},
                                         EffectParameter{"offset", "-", 0.0, Range::any, 0.05, 0.6}};

  template <class S>
  static void apply(const S* p, RotorSeam<S>& seam) {
    const S x = seam.Omega * *seam.per_Omega_hover, beyond = x - 1.0;
    seam.T = seam.T * (1.0 + p[0] * beyond + p[1] * (beyond * beyond / (x * x + 0.02)));
  }
};

}  // namespace ident
