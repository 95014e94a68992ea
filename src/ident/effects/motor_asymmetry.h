// Motor asymmetry: the rotor slows down with another natural frequency than it speeds up.
//
//   omega_m -> ratio omega_m   while Omega is above its target
//
// Propellers are braked by drag only where the speed controller cannot brake.
// Looks like: the sign of the speed error follows the sign of the acceleration.
// Confused with: parameter:omega_m, thrust_curve.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct MotorAsymmetry {
  static constexpr EffectInfo info{
      .name = "motor_asymmetry",
      .touches = kTouchAsymmetry,
      .equation = "omega_m -> ratio omega_m   while Omega is above its target",
      .looks_like = "the sign of the speed error follows the sign of the acceleration",
      .confused_with = "parameter:omega_m, thrust_curve",
      .split_by = "steps up and down on the bench"};
  static constexpr std::array parameters{EffectParameter{"ratio", "-", 1.0, Range::any, 0.2, 0.9}};

  template <class S>
  static void apply(const S* p, DriveSeam<S>& seam) {
    seam.down_ratio = seam.down_ratio * p[0];
  }
};

}  // namespace ident
