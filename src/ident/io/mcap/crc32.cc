// The checksum of MCAP chunks: CRC-32 of IEEE 802.3, as zlib computes it.
#include "ident/io/mcap/crc32.h"

#include <array>
#include <cstring>

namespace ident::mcap {

namespace {

/// Table k moves the remainder of a byte k further bytes on: eight bytes are then taken at once.
constexpr std::array<std::array<std::uint32_t, 256>, 8> make_tables() {
  constexpr std::uint32_t polynomial = 0xEDB88320u;  // reversed bits of 0x04C11DB7
  std::array<std::array<std::uint32_t, 256>, 8> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder >> 1) ^ ((remainder & 1u) != 0 ? polynomial : 0u);
    tables[0][byte] = remainder;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t byte = 0; byte < 256; ++byte)
      tables[k][byte] = (tables[k - 1][byte] >> 8) ^ tables[0][tables[k - 1][byte] & 0xff];
  return tables;
}

constexpr auto tables = make_tables();

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t remainder = 0xffffffffu;
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) {
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
      sum ^=
          tables[7 - k][bytes[at + k] ^ ((remainder >> (8 * k)) & 0xff)] ^ tables[3 - k][bytes[at + 4 + k]];
    remainder = sum;
  }
  for (; at < bytes.size(); ++at) remainder = (remainder >> 8) ^ tables[0][(remainder ^ bytes[at]) & 0xff];
  return ~remainder;
}

}  // namespace ident::mcap
