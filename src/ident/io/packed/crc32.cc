// CRC-32, eight bytes at a time.
#include "ident/io/packed/crc32.h"

#include <array>

#include "ident/io/packed/little_endian.h"

namespace ident {
namespace {

constexpr std::uint32_t kPolynomial = 0xEDB88320U;  // x^32 + x^26 + ... + 1, reflected
using Table = std::array<std::array<std::uint32_t, 256>, 8>;

/// table[k][b]: what byte b does to the sum k bytes later.
constexpr Table make_table() {
  Table table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t sum = byte;
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ (sum & 1U ? kPolynomial : 0U);
    table[0][byte] = sum;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t byte = 0; byte < 256; ++byte)
      table[k][byte] = (table[k - 1][byte] >> 8) ^ table[0][table[k - 1][byte] & 0xFFU];
  return table;
}
constexpr Table kTable = make_table();

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t sum = 0xFFFFFFFFU;
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) {
    const std::uint64_t eight = load<std::uint64_t>(bytes.data() + at) ^ sum;
    sum = 0;
    for (std::size_t k = 0; k < 8; ++k) sum ^= kTable[7 - k][(eight >> (8 * k)) & 0xFFU];
  }
  for (; at < bytes.size(); ++at)
    sum = (sum >> 8) ^ kTable[0][(sum ^ static_cast<unsigned char>(bytes[at])) & 0xFFU];
  return ~sum;
}

}  // namespace ident
