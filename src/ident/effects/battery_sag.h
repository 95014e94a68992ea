// Battery sag: with falling voltage a command gives less rotor speed.
//
//   Omega_steady *= (vbat/v0)^n (1 - rate t)
//
// v0 is the voltage at which km holds; `rate` serves logs without voltage.
// Looks like: slow drift of the thrust per command, and dips with collective; only where rotor speed is not
// measured. Confused with: parameter:km, thrust_curve, payload.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct BatterySag {
  static constexpr EffectInfo info{
      .name = "battery_sag",
      .touches = kTouchGain,
      .equation = "Omega_steady *= (vbat/v0)^n (1 - rate t)",
      .looks_like =
          "slow drift of the thrust per command, and dips with collective; only where rotor speed is not "
          "measured",
      .confused_with = "parameter:km, thrust_curve, payload",
      .split_by = "measure rotor speed or log the voltage; hover at the start and at the end of a pack"};
  static constexpr std::array parameters{EffectParameter{"n", "-", 0.0, Range::positive, 0.3, 3.0},
                                         EffectParameter{"rate", "1/s", 0.0, Range::positive, 0.0005, 0.02}};

  template <class S>
  static void apply(const S* p, DriveSeam<S>& seam) {
    using std::exp;
    if (seam.has_voltage) seam.gain = seam.gain * exp(p[0] * std::log(seam.voltage_ratio));
    seam.gain = seam.gain * (1.0 - p[1] * seam.t);
  }
};

}  // namespace ident
