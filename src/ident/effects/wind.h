// Wind: the air moves over the ground, so drag acts on the velocity against the air.
//
//   v_air = v - R^T w
//
// Constant over a log. Acts through the drag terms that the model has.
// Looks like: a force fixed in the world: turns in the body frame when the vehicle yaws.
// Confused with: imu_bias, cg_offset, rotor_drag.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct Wind {
  static constexpr EffectInfo info{
      .name = "wind",
      .touches = kTouchFlow,
      .equation = "v_air = v - R^T w",
      .looks_like = "a force fixed in the world: turns in the body frame when the vehicle yaws",
      .confused_with = "imu_bias, cg_offset, rotor_drag",
      .split_by = "a slow turn through 360 degrees at hover: wind stays in the world, a bias in the body"};
  static constexpr std::array parameters{EffectParameter{"north", "m/s", 0.0, Range::any, 2.0, 40.0},
                                         EffectParameter{"east", "m/s", 0.0, Range::any, 2.0, 40.0},
                                         EffectParameter{"down", "m/s", 0.0, Range::any, 1.0, 20.0}};

  template <class S>
  static void apply(const S* p, AirSeam<S>& seam) {
    for (int i = 0; i < 3; ++i) seam.wind_W[i] += p[i];
  }
};

}  // namespace ident
