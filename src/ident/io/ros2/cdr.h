// Reads the bytes of a message in Common Data Representation, as DDS writes it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace ident::ros2 {

/// A position in one message. Numbers are aligned to their size, counted from behind the four bytes that name
/// the encoding. After the first read past the end all others fail too, and give zeros.
class CdrReader {
 public:
  /// Plain CDR of either byte order, version 1 or 2 (which aligns to 4 bytes at most). Anything else fails.
  explicit CdrReader(std::span<const std::uint8_t> message) {
    if (message.size() < 4) return;
    const std::uint8_t kind = message[1];
    ok_ = message[0] == 0 && (kind == 0 || kind == 1 || kind == 6 || kind == 7);
    swap_ = (kind & 1u) == 0;
    widest_ = kind >= 6 ? 4 : 8;
    body_ = message.subspan(4);
  }

  bool ok() const { return ok_; }
  std::size_t left() const { return body_.size() - at_; }

  template <typename Number>
  Number number() {
    align(sizeof(Number));
    if (!ok_ || left() < sizeof(Number)) return fail<Number>();
    std::uint8_t raw[sizeof(Number)];
    std::memcpy(raw, body_.data() + at_, sizeof raw);
    at_ += sizeof raw;
    if constexpr (sizeof(Number) > 1)
      if (swap_) std::reverse(raw, raw + sizeof raw);
    return std::bit_cast<Number>(raw);
  }

  /// Text without its final zero.
  std::string_view string() {
    const auto length = number<std::uint32_t>();
    if (!ok_ || length > left()) return fail<std::string_view>();
    const std::string_view text(reinterpret_cast<const char*>(body_.data()) + at_, length);
    at_ += length;
    return text.ends_with('\0') ? text.substr(0, text.size() - 1) : text;
  }

  /// Passes over `count` numbers of `size` bytes each.
  void skip(std::uint64_t count, std::size_t size) {
    if (count == 0) return;
    align(size);
    if (!ok_ || count > left() / size) {
      ok_ = false;
      return;
    }
    at_ += static_cast<std::size_t>(count) * size;
  }

  /// Number of elements of a sequence, each of at least `least` bytes; fails where they cannot be there.
  std::uint32_t length(std::size_t least) {
    const auto count = number<std::uint32_t>();
    if (!ok_ || count > left() / least) return fail<std::uint32_t>();
    return count;
  }

 private:
  template <typename Value>
  Value fail() {
    ok_ = false;
    return Value{};
  }
  void align(std::size_t size) {
    const std::size_t to = std::min(size, widest_);
    const std::size_t aligned = (at_ + to - 1) / to * to;
    if (aligned > body_.size()) ok_ = false;
    at_ = std::min(aligned, body_.size());
  }

  std::span<const std::uint8_t> body_;
  std::size_t at_ = 0;
  std::size_t widest_ = 8;
  bool swap_ = false;
  bool ok_ = false;
};

}  // namespace ident::ros2
