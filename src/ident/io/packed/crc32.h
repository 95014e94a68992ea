// The check sum of card logs and of MCAP chunks.
#pragma once

#include <cstdint>
#include <string_view>

namespace ident {

/// CRC-32 of ISO 3309, as zlib computes it.
std::uint32_t crc32(std::string_view bytes);

}  // namespace ident
