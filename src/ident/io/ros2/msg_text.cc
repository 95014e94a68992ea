// Reads message definitions written as `.msg` text.
#include "ident/io/ros2/msg_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace ident::ros2 {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::optional<Type> primitive(std::string_view name) {
  static const std::map<std::string_view, Type> names{
      {"bool", Type::boolean},    {"byte", Type::uint8},    {"char", Type::uint8},
      {"int8", Type::int8},       {"uint8", Type::uint8},   {"int16", Type::int16},
      {"uint16", Type::uint16},   {"int32", Type::int32},   {"uint32", Type::uint32},
      {"int64", Type::int64},     {"uint64", Type::uint64}, {"float32", Type::float32},
      {"float64", Type::float64}, {"string", Type::string}, {"wstring", Type::wstring}};
  const auto found = names.find(name);
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

/// Name of a nested type as seen from a package: `Point` is of the same package, `Header` of std_msgs.
std::string resolved(std::string_view name, std::string_view package) {
  if (name.find('/') != std::string_view::npos) return plain_type_name(name);
  if (name == "Header") return "std_msgs/Header";
  return fmt::format("{}/{}", package, name);
}

/// `float64[36]`, `string<=10`, `Point[<=4]`, `uint8[]`. False where the brackets are wrong.
bool read_type(std::string_view text, std::string_view package, MessageField& field) {
  if (const std::size_t open = text.find('['); open != std::string_view::npos) {
    if (text.back() != ']') return false;
    const std::string_view size = text.substr(open + 1, text.size() - open - 2);
    field.repeat = size.empty() || size.starts_with("<=") ? Repeat::sequence : Repeat::array;
    if (field.repeat == Repeat::array) {
      const auto [end, error] = std::from_chars(size.data(), size.data() + size.size(), field.count);
      if (error != std::errc{} || end != size.data() + size.size()) return false;
    }
    text = text.substr(0, open);
  }
  text = text.substr(0, text.find("<="));
  if (text.empty()) return false;
  if (const auto type = primitive(text)) {
    field.type = *type;
  } else {
    field.type = Type::nested;
    field.nested = resolved(text, package);
  }
  return true;
}

/// A field of a line; nothing for blank lines, comments and constants.
struct Line {
  std::optional<MessageField> field;
  bool wrong = false;
};

Line read_line(std::string_view line, std::string_view package) {
  // A `#` in the default of a string is no comment, but nothing behind the name is read anyway.
  line = trimmed(line.substr(0, line.find('#')));
  if (line.empty()) return {};
  const std::size_t space = line.find_first_of(" \t");
  if (space == std::string_view::npos) return {.field = {}, .wrong = true};
  const std::string_view type = line.substr(0, space);
  const std::string_view rest = trimmed(line.substr(space));
  const std::string_view name = rest.substr(0, rest.find_first_of(" \t="));
  const std::string_view behind = trimmed(rest.substr(name.size()));
  if (behind.starts_with('=')) return {};  // a constant: nothing of it is in a message
  MessageField field{.name = std::string(name)};
  if (name.empty() || !read_type(type, package, field)) return {.field = {}, .wrong = true};
  return {.field = std::move(field)};
}

}  // namespace

std::string plain_type_name(std::string_view name) {
  std::string plain;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find('/'), name.find("::"));
    const std::string_view part = name.substr(0, end);
    if (part != "msg") {
      if (!plain.empty()) plain += '/';
      plain += part;
    }
    if (end == std::string_view::npos) break;
    name.remove_prefix(end + (name[end] == '/' ? 1 : 2));
  }
  return plain;
}

ParsedDefinitions parse_msg_text(std::string_view type, std::string_view text) {
  ParsedDefinitions parsed;
  std::string name = plain_type_name(type);
  std::vector<MessageField>* fields = &parsed.types[name];
  long number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    ++number;
    if (line.starts_with("====")) continue;
    if (line.starts_with("MSG:")) {
      name = plain_type_name(trimmed(line.substr(4)));
      fields = &parsed.types[name];
      fields->clear();
      continue;
    }
    Line read = read_line(line, std::string_view(name).substr(0, name.find('/')));
    if (read.wrong) {
      parsed.problem = fmt::format("line {} of its definition is not understood: {}", number, trimmed(line));
      return parsed;
    }
    if (read.field) fields->push_back(std::move(*read.field));
  }
  return parsed;
}

}  // namespace ident::ros2
