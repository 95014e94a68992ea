// Rotor mismatch: one rotor gives less (or more) thrust and torque than the others at the same speed.
//
//   kT_k, kQ_k = ratio@k (kT, kQ)
//
// A chipped, wrong or worn propeller. One entry for each rotor; the file names it by `rotor` and `ratio`.
// Looks like: follows one rotor in Fz, the moments and Mz together.
// Confused with: cg_offset, rotor_tilt, payload.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct RotorMismatch {
  static constexpr EffectInfo info{
      .name = "rotor_mismatch",
      .touches = kTouchRotor,
      .equation = "kT_k, kQ_k = ratio@k (kT, kQ)",
      .looks_like = "follows one rotor in Fz, the moments and Mz together",
      .confused_with = "cg_offset, rotor_tilt, payload",
      .split_by = "strong doublets at constant collective, or swap two propellers: the fault moves along"};
  static constexpr std::array parameters{EffectParameter{"ratio@1", "-", 1.0, Range::any, 0.05, 0.6},
                                         EffectParameter{"ratio@2", "-", 1.0, Range::any, 0.05, 0.6},
                                         EffectParameter{"ratio@3", "-", 1.0, Range::any, 0.05, 0.6},
                                         EffectParameter{"ratio@4", "-", 1.0, Range::any, 0.05, 0.6},
                                         EffectParameter{"ratio@5", "-", 1.0, Range::any, 0.05, 0.6},
                                         EffectParameter{"ratio@6", "-", 1.0, Range::any, 0.05, 0.6},
                                         EffectParameter{"ratio@7", "-", 1.0, Range::any, 0.05, 0.6},
                                         EffectParameter{"ratio@8", "-", 1.0, Range::any, 0.05, 0.6}};

  template <class S>
  static void apply(const S* p, RotorSeam<S>& seam) {
    seam.T = seam.T * p[seam.index];
    seam.Q = seam.Q * p[seam.index];
  }
};

}  // namespace ident
