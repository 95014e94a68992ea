// Sensor delay: rates and attitude show what was true a while ago.
//
//   shown(t) = truth(t - tau)
//
// Rates and attitude together; specific force is not delayed.
// Looks like: phase linear in frequency on rates and attitude.
// Confused with: motor_delay, parameter:omega_m.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct SensorDelay {
  static constexpr EffectInfo info{
      .name = "sensor_delay",
      .touches = 0,
      .equation = "shown(t) = truth(t - tau)",
      .looks_like = "phase linear in frequency on rates and attitude",
      .confused_with = "motor_delay, parameter:omega_m",
      .split_by = "measure rotor speed, or compare gyro and accelerometer in a tap test"};
  static constexpr std::array parameters{EffectParameter{"tau", "s", 0.0, Range::positive, 0.005, 0.2}};

  template <class S>
  static void apply(const S* p, TimeSeam<S>& seam) {
    seam.sensor_delay = seam.sensor_delay + p[0];
  }
};

}  // namespace ident
