// Products of inertia: principal axes that are not the body axes.
//
//   J_ij += Jxy, Jxz, Jyz   (matrix elements, -integral(x y dm))
//
// The vehicle file states a diagonal J.
// Looks like: angular acceleration about one axis from a moment about another, at high frequency.
// Confused with: imu_misalignment, cg_offset, rotor_tilt.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct ProductsOfInertia {
  static constexpr EffectInfo info{
      .name = "products_of_inertia",
      .touches = 0,
      .equation = "J_ij += Jxy, Jxz, Jyz   (matrix elements, -integral(x y dm))",
      .looks_like = "angular acceleration about one axis from a moment about another, at high frequency",
      .confused_with = "imu_misalignment, cg_offset, rotor_tilt",
      .split_by = "doublets about one axis at a time"};
  static constexpr std::array parameters{EffectParameter{"Jxy", "kg m^2", 0.0, Range::any, 5e-05, 2.5e-3},
                                         EffectParameter{"Jxz", "kg m^2", 0.0, Range::any, 5e-05, 2.5e-3},
                                         EffectParameter{"Jyz", "kg m^2", 0.0, Range::any, 5e-05, 2.5e-3}};

  template <class S>
  static void apply(const S* p, MassSeam<S>& seam) {
    seam.J(0, 1) += p[0], seam.J(1, 0) += p[0];
    seam.J(0, 2) += p[1], seam.J(2, 0) += p[1];
    seam.J(1, 2) += p[2], seam.J(2, 1) += p[2];
  }
};

}  // namespace ident
