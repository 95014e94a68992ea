// Bytes of messages and MCAP records, for tests that write bags by hand.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace ident {

template <typename Number>
std::string little_endian(Number value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// A message in CDR, little endian: numbers are aligned from behind the four bytes of its head.
class CdrText {
 public:
  template <typename Number>
  CdrText& number(Number value) {
    while ((bytes_.size() - 4) % sizeof value != 0) bytes_ += '\0';
    bytes_ += little_endian(value);
    return *this;
  }
  CdrText& string(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    bytes_ += text;
    bytes_ += '\0';
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_ = std::string("\0\1\0\0", 4);
};

inline std::string mcap_string(std::string_view text) {
  return little_endian(static_cast<std::uint32_t>(text.size())) + std::string(text);
}
inline std::string mcap_record(int op, const std::string& content) {
  return std::string(1, static_cast<char>(op)) + little_endian<std::uint64_t>(content.size()) + content;
}
inline std::string mcap_schema(std::uint16_t id, std::string_view name, std::string_view encoding,
                               std::string_view text) {
  return mcap_record(3, little_endian(id) + mcap_string(name) + mcap_string(encoding) + mcap_string(text));
}
inline std::string mcap_channel(std::uint16_t id, std::uint16_t schema, std::string_view topic,
                                std::string_view encoding = "cdr") {
  return mcap_record(4, little_endian(id) + little_endian(schema) + mcap_string(topic) +
                            mcap_string(encoding) + little_endian<std::uint32_t>(0));
}
inline std::string mcap_message(std::uint16_t channel, std::uint64_t time_ns, const std::string& message) {
  return mcap_record(5, little_endian(channel) + little_endian<std::uint32_t>(0) + little_endian(time_ns) +
                            little_endian(time_ns) + message);
}
inline std::string mcap_file(const std::string& records) {
  const std::string magic = "\x89MCAP0\r\n";
  return magic + records + mcap_record(15, little_endian<std::uint32_t>(0)) +
         mcap_record(2, std::string(20, '\0')) + magic;
}

}  // namespace ident
