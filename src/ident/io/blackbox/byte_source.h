// Reads bytes and variable-byte numbers from a part of a blackbox file, never past its end.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace ident::blackbox {

/// A position in the bytes of one log. Past the end a byte is 0xff and a number 0, as in blackbox_decode;
/// that is remembered.
struct ByteSource {
  std::span<const std::uint8_t> bytes;
  std::size_t at = 0;
  bool past_end = false;

  std::uint8_t byte() {
    if (at < bytes.size()) return bytes[at++];
    past_end = true;
    return 0xff;
  }

  /// Seven bits a byte, the lowest first; the top bit says that another byte follows. Five bytes at most:
  /// a longer number is 0, as in blackbox_decode.
  std::uint32_t unsigned_vb() {
    if (at < bytes.size() && bytes[at] < 0x80) return bytes[at++];
    std::uint32_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const std::uint8_t b = byte();
      if (past_end) return 0;
      value |= static_cast<std::uint32_t>(b & 0x7f) << shift;
      if (b < 0x80) return value;
    }
    return 0;
  }

  /// The same with the sign in the lowest bit.
  std::int32_t signed_vb() {
    const std::uint32_t z = unsigned_vb();
    return static_cast<std::int32_t>((z >> 1) ^ (0u - (z & 1u)));
  }

  float float32() {
    std::uint32_t bits = 0;
    for (int shift = 0; shift < 32; shift += 8) bits |= static_cast<std::uint32_t>(byte()) << shift;
    return std::bit_cast<float>(bits);
  }
};

}  // namespace ident::blackbox
