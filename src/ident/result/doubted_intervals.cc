// Deviations by the distance from what was stated.
#include "ident/result/doubted_intervals.h"

#include <algorithm>
#include <cmath>

namespace ident {

void widen_doubted(std::vector<Parameter>& parameters) {
  constexpr double kNormal95 = 1.96;  // standard deviations
  for (Parameter& p : parameters) {
    if (p.identifiable || p.joint || !p.prior_value) continue;
    const double moved = std::abs(p.value - *p.prior_value);
    if (!(moved > p.std)) continue;
    p.std = moved;
    p.ci95 = {std::min(p.ci95[0], p.value - kNormal95 * moved),
              std::max(p.ci95[1], p.value + kNormal95 * moved)};
  }
}

}  // namespace ident
