// The records of an MCAP file, and how their fields lie in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

namespace ident::mcap {

using Bytes = std::span<const std::uint8_t>;

enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  metadata = 0x0C,
  data_end = 0x0F,
};

/// Reads the fields of a record one after the other. After the first that is not there, all are empty.
class RecordReader {
 public:
  explicit RecordReader(Bytes bytes) : bytes_(bytes) {}

  template <typename Number>
  Number number() {
    const Bytes raw = take(sizeof(Number));
    Number value{};
    if (raw.size() == sizeof value) std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  Bytes take(std::uint64_t count) {
    if (!ok_ || count > bytes_.size() - at_) {
      ok_ = false;
      return {};
    }
    const Bytes taken = bytes_.subspan(at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return taken;
  }
  std::string_view string() {
    const Bytes text = take(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(text.data()), text.size()};
  }
  Bytes rest() const { return ok_ ? bytes_.subspan(at_) : Bytes{}; }
  bool ok() const { return ok_; }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

struct Record {
  Op op{};
  Bytes content;
  std::size_t end = 0;  ///< position behind it
  bool whole = true;    ///< false where the bytes end within it; `content` is then what is there
};

/// The record that begins at `at`; nothing where not even its head is there.
std::optional<Record> record_at(Bytes bytes, std::size_t at);

}  // namespace ident::mcap
