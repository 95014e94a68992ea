// Their expansion to second order in the frequency.
#include "ident/data/low_pass.h"

#include <cmath>
#include <numbers>

namespace ident {

double LowPass::corner() const { return 1 / (2 * std::numbers::pi * std::sqrt(square)); }

LowPass butterworth(double cutoff) {
  const double w = 2 * std::numbers::pi * cutoff;
  return {.lag = std::numbers::sqrt2 / w, .square = 1 / (w * w)};
}

LowPass in_a_row(const LowPass& first, const LowPass& second) {
  return {.lag = first.lag + second.lag, .square = first.square + second.square + first.lag * second.lag};
}

}  // namespace ident
