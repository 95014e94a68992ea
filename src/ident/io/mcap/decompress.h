// Unpacks the chunks of an MCAP file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ident::mcap {

struct Unpacked {
  std::vector<std::uint8_t> bytes;  ///< as far as they could be unpacked
  std::string problem;              ///< why not all could; empty where all were
};

/// `method` is `lz4` or `zstd`. At most `size` bytes are given, and no more than a thousand times what is
/// packed: more is damage, or made to fill the memory.
Unpacked decompress(std::string_view method, std::span<const std::uint8_t> packed, std::uint64_t size);

}  // namespace ident::mcap
