// Payload: a point mass at a place: mass, inertia and centre of gravity change together.
//
//   m' = m + m_p,  c = m_p r/m',  J' = J + m m_p/m' (r^2 I - r r^T)
//
// Parallel axes of both bodies about their common centre of gravity. Assumes the body's own centre at the
// origin before. Looks like: Fz, the gain of the rates and the centre of gravity at once. Confused with:
// parameter:m, cg_offset, parameter:kT.
#pragma once

#include "ident/effects/effect.h"

namespace ident {

struct Payload {
  static constexpr EffectInfo info{
      .name = "payload",
      .touches = kTouchCentre,
      .equation = "m' = m + m_p,  c = m_p r/m',  J' = J + m m_p/m' (r^2 I - r r^T)",
      .looks_like = "Fz, the gain of the rates and the centre of gravity at once",
      .confused_with = "parameter:m, cg_offset, parameter:kT",
      .split_by = "put the vehicle on a scale"};
  static constexpr std::array parameters{EffectParameter{"m", "kg", 0.0, Range::positive, 0.02, 0.5},
                                         EffectParameter{"x", "m", 0.0, Range::any, 0.02, 1.0},
                                         EffectParameter{"y", "m", 0.0, Range::any, 0.02, 1.0},
                                         EffectParameter{"z", "m", 0.0, Range::any, 0.03, 1.0}};

  template <class S>
  static void apply(const S* p, MassSeam<S>& seam) {
    const S total = seam.m + p[0];
    const Vec3<S> r(p[1], p[2], p[3]);
    const S reduced = seam.m * p[0] / total;
    const S r2 = dot(r, r);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) seam.J(i, k) = seam.J(i, k) - reduced * r[i] * r[k];
      seam.J(i, i) = seam.J(i, i) + reduced * r2;
      seam.c_B[i] = seam.c_B[i] + (p[0] / total) * r[i];
    }
    seam.m = total;
  }
};

}  // namespace ident
