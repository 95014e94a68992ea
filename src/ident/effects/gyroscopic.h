// Gyroscopic: the momentum of the spinning rotors, which the vehicle file leaves out.
//
//   M -= sum_n s_n Jp (Omega_n' a_n + Omega_n w x a_n)
//
// Adds to the file's Jp. With the printed signs of [Phang 16, 18, 19] the estimate comes out negative in that
// model. Looks like: Mx with q and My with -p when the spins do not cancel; Mz leads with the rotor
// acceleration. Confused with: parameter:kQ, parameter:omega_m, products_of_inertia.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct Gyroscopic {
  static constexpr EffectInfo info{
      .name = "gyroscopic",
      .touches = kTouchSpin,
      .equation = "M -= sum_n s_n Jp (Omega_n' a_n + Omega_n w x a_n)",
      .looks_like =
          "Mx with q and My with -p when the spins do not cancel; Mz leads with the rotor acceleration",
      .confused_with = "parameter:kQ, parameter:omega_m, products_of_inertia",
      .split_by = "fast yaw doublets, and pitching while rolling"};
  static constexpr std::array parameters{EffectParameter{"Jp", "kg m^2", 0.0, Range::any, 3e-06, 6e-05}};

  template <class S>
  static void apply(const S* p, MassSeam<S>& seam) {
    seam.Jp = seam.Jp + p[0];
  }
};

}  // namespace ident
