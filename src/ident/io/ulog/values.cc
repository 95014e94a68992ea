// Parses keys with a type and the value behind them.
#include "ident/io/ulog/values.h"

#include <fmt/format.h>

#include "ident/io/packed/little_endian.h"

namespace ident::ulog {
namespace {

template <class Number>
bool take(std::string_view bytes, KeyValue& to) {
  if (bytes.size() < sizeof(Number)) return false;
  const Number value = load<Number>(bytes.data());
  to.number = static_cast<double>(value);
  to.text = fmt::format("{}", value);
  return true;
}

bool take_number(std::string_view type, std::string_view bytes, KeyValue& to) {
  if (type == "int8_t") return take<std::int8_t>(bytes, to);
  if (type == "uint8_t" || type == "bool") return take<std::uint8_t>(bytes, to);
  if (type == "int16_t") return take<std::int16_t>(bytes, to);
  if (type == "uint16_t") return take<std::uint16_t>(bytes, to);
  if (type == "int32_t") return take<std::int32_t>(bytes, to);
  if (type == "uint32_t") return take<std::uint32_t>(bytes, to);
  if (type == "int64_t") return take<std::int64_t>(bytes, to);
  if (type == "uint64_t") return take<std::uint64_t>(bytes, to);
  if (type == "float") return take<float>(bytes, to);
  if (type == "double") return take<double>(bytes, to);
  return false;
}

}  // namespace

std::optional<KeyValue> parse_key_value(std::string_view payload) {
  if (payload.empty()) return std::nullopt;
  const std::size_t length = static_cast<unsigned char>(payload.front());
  if (payload.size() < 1 + length) return std::nullopt;
  const std::string_view typed = payload.substr(1, length);
  const std::string_view value = payload.substr(1 + length);
  const std::size_t blank = typed.find(' ');
  if (blank == std::string_view::npos) return std::nullopt;
  KeyValue found;
  found.key = typed.substr(blank + 1);
  const std::string_view type = typed.substr(0, blank);
  if (type.starts_with("char["))
    found.text = value;
  else if (!take_number(type, value, found))
    return std::nullopt;
  return found;
}

}  // namespace ident::ulog
