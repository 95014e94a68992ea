// What every effect states about itself: parameters, physical range, how it looks and what it is confused
// with.
//
// An effect is a struct in a file of its own, listed in effects.def. It has
//   static constexpr EffectInfo info{...};
//   static constexpr std::array parameters{EffectParameter{...}, ...};
//   template <class S> static void apply(const S* p, SomeSeam<S>& seam);   for each seam that it enters
//   (model/seams.h)
// with `p` its own parameters in that order. It must do nothing at the null values and be of first order
// there.
#pragma once

#include <array>
#include <string_view>

#include "ident/model/seams.h"

namespace ident {

enum class Range { any, positive };

struct EffectParameter {
  std::string_view name, unit;
  double null_value = 0.0;
  Range range = Range::any;  ///< physical sign relative to the null value
  double typical = 1.0;      ///< a plausible size above which it matters, in its unit, for a 0.5 kg vehicle
  double limit = 1e9;        ///< farther from null the value is not physical, for such a vehicle
};

struct EffectInfo {
  std::string_view name;
  unsigned touches = 0;  ///< Touch flags
  std::string_view equation;
  std::string_view looks_like;
  std::string_view confused_with;
  std::string_view split_by;  ///< the flight or bench test that tells it from those
};

}  // namespace ident
