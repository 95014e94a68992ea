// The checksum of MCAP chunks: CRC-32 of IEEE 802.3, as zlib computes it.
#pragma once

#include <cstdint>
#include <span>

namespace ident::mcap {

std::uint32_t crc32(std::span<const std::uint8_t> bytes);

}  // namespace ident::mcap
