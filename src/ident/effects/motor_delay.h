// Motor delay: a dead time between command and motor.
//
//   delta(t) -> delta(t - tau)
//
// Adds to the dead time that the file states.
// Looks like: phase of the rotor response linear in frequency.
// Confused with: sensor_delay, parameter:omega_m.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct MotorDelay {
  static constexpr EffectInfo info{
      .name = "motor_delay",
      .touches = 0,
      .equation = "delta(t) -> delta(t - tau)",
      .looks_like = "phase of the rotor response linear in frequency",
      .confused_with = "sensor_delay, parameter:omega_m",
      .split_by = "measure rotor speed, or a frequency sweep: lag bends, delay does not"};
  static constexpr std::array parameters{EffectParameter{"tau", "s", 0.0, Range::positive, 0.005, 0.2}};

  template <class S>
  static void apply(const S* p, TimeSeam<S>& seam) {
    seam.command_delay = seam.command_delay + p[0];
  }
};

}  // namespace ident
