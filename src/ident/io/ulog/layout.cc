// Parses format definitions and writes nested types out.
#include "ident/io/ulog/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace ident::ulog {
namespace {

constexpr std::size_t kLargestRecord = 65533;  // bytes: u16 size of a message, less the message id
constexpr int kDeepest = 16;                   // nested types; PX4 has two
constexpr int kMostSteps = 100000;             // more than a record has bytes: types without any bytes

struct Number {
  std::string_view name;
  PackedType type;
};
constexpr std::array<Number, 11> kNumbers = {{{"int8_t", PackedType::i8},
                                              {"uint8_t", PackedType::u8},
                                              {"int16_t", PackedType::i16},
                                              {"uint16_t", PackedType::u16},
                                              {"int32_t", PackedType::i32},
                                              {"uint32_t", PackedType::u32},
                                              {"int64_t", PackedType::i64},
                                              {"uint64_t", PackedType::u64},
                                              {"float", PackedType::f32},
                                              {"double", PackedType::f64},
                                              {"bool", PackedType::u8}}};

std::optional<Member> parse_member(std::string_view text) {
  const std::size_t blank = text.find(' ');
  if (blank == std::string_view::npos || blank == 0 || blank + 1 == text.size()) return std::nullopt;
  Member member;
  std::string_view type = text.substr(0, blank);
  member.name = text.substr(blank + 1);
  if (const std::size_t open = type.find('['); open != std::string_view::npos) {
    const char* end = type.data() + type.size();
    const auto [stop, error] = std::from_chars(type.data() + open + 1, end, member.count);
    if (error != std::errc() || stop + 1 != end || *stop != ']' || member.count > kLargestRecord)
      return std::nullopt;
    type = type.substr(0, open);
  }
  member.type = type;
  return member;
}

class Writer {
 public:
  explicit Writer(const Definitions& definitions) : definitions_(definitions) {}

  std::optional<Layout> run(std::string_view name) {
    if (!add_type(name, "", 0)) return std::nullopt;
    return std::move(out_);
  }

 private:
  bool add_type(std::string_view name, const std::string& prefix, int depth) {
    const auto at = definitions_.find(name);
    if (at == definitions_.end() || depth > kDeepest) return false;
    return std::ranges::all_of(at->second,
                               [&](const Member& member) { return add_member(member, prefix, depth); });
  }

  bool add_member(const Member& member, const std::string& prefix, int depth) {
    if (member.type == "char") return advance(member.count, true);
    const auto number = std::ranges::find(kNumbers, member.type, &Number::name);
    if (number != kNumbers.end() && member.name.starts_with("_padding"))
      return advance(member.count * size_of(number->type), depth > 0);
    for (std::size_t i = 0; i < member.count; ++i) {
      if (++steps_ > kMostSteps) return false;
      const std::string name =
          prefix + (member.count > 1 ? fmt::format("{}[{}]", member.name, i) : member.name);
      const bool fits = number == kNumbers.end() ? add_type(member.type, name + ".", depth + 1)
                                                 : add_number(name, number->type);
      if (!fits) return false;
    }
    return true;
  }

  bool add_number(const std::string& name, PackedType type) {
    if (name == "timestamp" && type == PackedType::u64) out_.timestamp = out_.most;
    out_.fields.push_back({.name = name, .type = type, .offset = out_.most});
    return advance(size_of(type), true);
  }

  /// Only padding at the record's end may be missing.
  bool advance(std::size_t bytes, bool needed) {
    out_.most += bytes;
    if (needed) out_.least = out_.most;
    return out_.most <= kLargestRecord;
  }

  const Definitions& definitions_;
  Layout out_;
  int steps_ = 0;
};

}  // namespace

bool Layout::operator==(const Layout& other) const {
  return least == other.least && most == other.most &&
         std::ranges::equal(fields, other.fields, [](const PackedField& a, const PackedField& b) {
           return a.name == b.name && a.type == b.type && a.offset == b.offset;
         });
}

std::optional<Definition> parse_definition(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0) return std::nullopt;
  Definition definition{.name = std::string(text.substr(0, colon)), .members = {}};
  for (std::size_t at = colon + 1; at < text.size();) {
    const std::size_t end = std::min(text.find(';', at), text.size());
    if (end > at) {
      std::optional<Member> member = parse_member(text.substr(at, end - at));
      if (!member) return std::nullopt;
      definition.members.push_back(std::move(*member));
    }
    at = end + 1;
  }
  return definition;
}

std::optional<Layout> layout_of(std::string_view name, const Definitions& definitions) {
  return Writer(definitions).run(name);
}

}  // namespace ident::ulog
