// The records of an MCAP file, and how their fields lie in them.
#include "ident/io/mcap/records.h"

#include <algorithm>

namespace ident::mcap {

std::optional<Record> record_at(Bytes bytes, std::size_t at) {
  constexpr std::size_t head = 1 + sizeof(std::uint64_t);
  if (at > bytes.size() || bytes.size() - at < head) return std::nullopt;
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data() + at + 1, sizeof length);
  const std::size_t there = bytes.size() - at - head;
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(length, there));
  return Record{static_cast<Op>(bytes[at]), bytes.subspan(at + head, size), at + head + size,
                length <= there};
}

}  // namespace ident::mcap
