// Format definitions of a ULog, and where each number of a record lies.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ident/io/packed/records.h"

namespace ident::ulog {

/// One `type[count] name` of a definition; the type is a number's or that of another definition.
struct Member {
  std::string type, name;
  std::size_t count = 1;
};

struct Definition {
  std::string name;
  std::vector<Member> members;
};

/// Reads `name:type field;type[n] field;`. Empty where the text is not of that form.
std::optional<Definition> parse_definition(std::string_view text);

using Definitions = std::map<std::string, std::vector<Member>, std::less<>>;

/// Numbers of a record with nested types written out: `esc[0].esc_rpm`. A bool is a number; characters and
/// padding are left out. A record may lack the padding at its end: it has `least` to `most` bytes.
struct Layout {
  std::vector<PackedField> fields;
  std::size_t least = 0, most = 0;
  std::optional<std::size_t> timestamp;  ///< offset of the u64 of that name

  bool operator==(const Layout& other) const;
};

/// Empty where a type is not defined, where types hold each other, or where a record would not fit into a
/// message.
std::optional<Layout> layout_of(std::string_view name, const Definitions& definitions);

}  // namespace ident::ulog
