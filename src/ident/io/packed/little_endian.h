// Numbers out of little-endian bytes at any address.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace ident {

static_assert(std::endian::native == std::endian::little, "logs are read in the machine's own byte order");

/// The number whose first byte is at `from`; the caller has checked that all its bytes are there.
template <class Number>
Number load(const char* from) {
  Number value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// IEEE 754 binary16 as a float; every value of it is one.
float half_to_float(std::uint16_t half);

}  // namespace ident
