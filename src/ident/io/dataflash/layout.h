// What an FMT message says: the name, columns and types of a kind of message.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ident/io/packed/records.h"

namespace ident::dataflash {

/// A column of text, `offset` bytes from the begin of a message.
struct TextColumn {
  std::string name;
  std::size_t offset = 0, size = 0;
};

struct Layout {
  std::string name;
  std::size_t length = 0;           ///< bytes of a message with its header of three
  std::vector<PackedField> fields;  ///< numbers, with the scale of their letter
  std::vector<TextColumn> texts;
  std::vector<std::size_t> place;  ///< of each number among all columns
  std::size_t columns = 0;

  const TextColumn* text(std::string_view column) const;
  const PackedField* field(std::string_view column) const;
};

/// Empty where a letter is not known, or where the letters' sizes do not add up to the stated length (0: not
/// stated, as in text).
std::optional<Layout> make_layout(std::string_view name, std::string_view letters, std::string_view columns,
                                  std::size_t length);

/// Text of fixed size up to its first zero.
std::string_view fixed_text(std::string_view bytes);

/// Field that tells the time, with its unit in s; old logs count milliseconds. Empty: none.
struct Clock {
  std::string field;
  double unit = 1e-6;
};
Clock clock_of(const Layout& layout);

}  // namespace ident::dataflash
