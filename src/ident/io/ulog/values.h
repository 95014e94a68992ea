// Key and value of a ULog's info and parameter messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ident::ulog {

struct KeyValue {
  std::string key, text;         ///< the value as text, whatever its type
  std::optional<double> number;  ///< of a value that is one number
};

/// Reads `u8 length, "type key", value`. Empty where the message is too short.
std::optional<KeyValue> parse_key_value(std::string_view payload);

}  // namespace ident::ulog
