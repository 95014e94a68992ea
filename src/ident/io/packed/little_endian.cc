// The half precision format.
#include "ident/io/packed/little_endian.h"

#include <cmath>
#include <limits>

namespace ident {

float half_to_float(std::uint16_t half) {
  const int exponent = (half >> 10) & 0x1F;
  const float fraction = static_cast<float>(half & 0x3FF);
  float size = 0.0F;
  if (exponent == 0)
    size = std::ldexp(fraction, -24);
  else if (exponent < 31)
    size = std::ldexp(1024.0F + fraction, exponent - 25);
  else
    size = fraction > 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
  return half & 0x8000 ? -size : size;
}

}  // namespace ident
