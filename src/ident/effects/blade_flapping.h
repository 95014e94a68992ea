// Blade flapping: the advancing blade lifts more, and the hub feels a moment that raises the nose.
//
//   M_i = kf Omega_i (v_i x a_i)   at each hub
//
// Sign: v = (v,0,0) and a = (0,0,-1) give +v about y, nose up. The tilt of the thrust is rotor_drag.
// Looks like: My with v_x and Mx with v_y, in proportion to rotor speed.
// Confused with: cg height, rotor_drag with hubs off the centre, rate damping.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct BladeFlapping {
  static constexpr EffectInfo info{
      .name = "blade_flapping",
      .touches = kTouchFlow | kTouchRotor | kTouchHub,
      .equation = "M_i = kf Omega_i (v_i x a_i)   at each hub",
      .looks_like = "My with v_x and Mx with v_y, in proportion to rotor speed",
      .confused_with = "cg height, rotor_drag with hubs off the centre, rate damping",
      .split_by = "fast level legs in four directions: the moment follows the velocity, not the rates"};
  static constexpr std::array parameters{
      EffectParameter{"kf", "N s^2/rad", 0.0, Range::positive, 2e-06, 1e-04}};

  template <class S>
  static void apply(const S* p, RotorSeam<S>& seam) {
    seam.M_B += (p[0] * seam.Omega) * cross(seam.v_air_B, seam.a_B);
  }
};

}  // namespace ident
