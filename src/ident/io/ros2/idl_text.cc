// Reads message definitions written as OMG IDL, the part of it that ROS 2 generates.
#include "ident/io/ros2/idl_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <charconv>
#include <optional>

#include "ident/io/ros2/msg_text.h"

namespace ident::ros2 {

namespace {

/// Splits IDL into names, numbers and signs; comments, `#include` lines, rulers and `IDL:` lines are left
/// out.
std::vector<std::string_view> tokens(std::string_view text) {
  std::vector<std::string_view> found;
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const auto skip_line = [&](std::size_t at) { return std::min(text.find('\n', at), text.size()); };
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
      ++at;
    } else if (rest.starts_with("//") || rest.starts_with('#') || rest.starts_with("====") ||
               rest.starts_with("IDL:")) {
      at = skip_line(at);
    } else if (rest.starts_with("/*")) {
      const std::size_t end = text.find("*/", at + 2);
      at = end == std::string_view::npos ? text.size() : end + 2;
    } else if (text[at] == '"') {
      std::size_t end = at + 1;
      while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2u : 1u;
      end = std::min(end + 1, text.size());
      found.push_back(text.substr(at, end - at));
      at = end;
    } else if (is_word(text[at])) {
      std::size_t end = at;
      while (end < text.size() && (is_word(text[end]) || text.substr(end).starts_with("::")))
        end += is_word(text[end]) ? 1u : 2u;
      found.push_back(text.substr(at, end - at));
      at = end;
    } else {
      found.push_back(text.substr(at++, 1));
    }
  }
  return found;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : tokens_(tokens(text)) {}

  ParsedDefinitions parse() {
    while (at_ < tokens_.size() && parsed_.problem.empty()) statement();
    return std::move(parsed_);
  }

 private:
  std::string_view peek() const { return at_ < tokens_.size() ? tokens_[at_] : std::string_view{}; }
  std::string_view next() { return at_ < tokens_.size() ? tokens_[at_++] : std::string_view{}; }
  void wrong(std::string_view what) {
    if (parsed_.problem.empty())
      parsed_.problem = fmt::format("its definition is not understood at `{}`", what);
    at_ = tokens_.size();
  }
  void skip_to(std::string_view sign) {
    while (at_ < tokens_.size() && next() != sign) {
    }
  }
  void skip_annotation() {
    next();  // its name
    if (peek() != "(") return;
    int depth = 0;
    do {
      const std::string_view token = next();
      depth += token == "(" ? 1 : token == ")" ? -1 : 0;
    } while (depth > 0 && at_ < tokens_.size());
  }

  std::string scope() const { return fmt::format("{}", fmt::join(modules_, "/")); }

  void statement() {
    const std::string_view token = next();
    if (token == "module") {
      modules_.emplace_back(next());
      if (next() != "{") wrong("module");
    } else if (token == "}") {
      if (!modules_.empty()) modules_.pop_back();
    } else if (token == "struct") {
      structure();
    } else if (token == "typedef") {
      MessageField field = type();
      declarator(field);
      aliases_[field.name] = field;
    } else if (token == "enum") {
      aliases_[std::string(next())] = MessageField{.name = {}, .type = Type::uint32};
      skip_to("}");
    } else if (token == "@") {
      skip_annotation();
    } else if (token == "const") {
      skip_to(";");
    } else if (token != ";") {
      wrong(token);
    }
  }

  void structure() {
    std::string name(next());
    if (next() != "{") return wrong(name);
    std::vector<MessageField> fields;
    while (at_ < tokens_.size() && peek() != "}") {
      if (peek() == "@") {
        next();
        skip_annotation();
        continue;
      }
      MessageField field = type();
      declarator(field);
      fields.push_back(std::move(field));
    }
    next();
    parsed_.types[plain_type_name(scope() + "/" + name)] = std::move(fields);
  }

  /// `name;` or `name[3];` behind a type.
  void declarator(MessageField& field) {
    field.name = std::string(next());
    if (peek() == "[") {
      next();
      const std::string_view size = next();
      if (field.repeat != Repeat::once || next() != "]" ||
          std::from_chars(size.data(), size.data() + size.size(), field.count).ec != std::errc{})
        return wrong(field.name);
      field.repeat = Repeat::array;
    }
    if (next() != ";") wrong(field.name);
  }

  MessageField type() {
    std::string name(next());
    if (name == "sequence") return sequence();
    if (name == "unsigned") name += " " + std::string(next());
    if ((name == "long" || name == "unsigned long") && (peek() == "long" || peek() == "double"))
      name += " " + std::string(next());
    if ((name == "string" || name == "wstring") && peek() == "<") skip_to(">");
    return named(name);
  }

  MessageField sequence() {
    if (next() != "<") wrong("sequence");
    MessageField field = type();
    if (field.repeat != Repeat::once) wrong("sequence of sequences");
    field.repeat = Repeat::sequence;
    if (peek() == ",") {
      next();
      next();
    }
    if (next() != ">") wrong("sequence");
    return field;
  }

  MessageField named(const std::string& name) {
    static const std::map<std::string_view, Type> names{{"boolean", Type::boolean},
                                                        {"octet", Type::uint8},
                                                        {"char", Type::uint8},
                                                        {"int8", Type::int8},
                                                        {"uint8", Type::uint8},
                                                        {"int16", Type::int16},
                                                        {"short", Type::int16},
                                                        {"uint16", Type::uint16},
                                                        {"unsigned short", Type::uint16},
                                                        {"int32", Type::int32},
                                                        {"long", Type::int32},
                                                        {"uint32", Type::uint32},
                                                        {"unsigned long", Type::uint32},
                                                        {"int64", Type::int64},
                                                        {"long long", Type::int64},
                                                        {"uint64", Type::uint64},
                                                        {"unsigned long long", Type::uint64},
                                                        {"float", Type::float32},
                                                        {"double", Type::float64},
                                                        {"string", Type::string},
                                                        {"wstring", Type::wstring}};
    if (const auto found = names.find(name); found != names.end()) return {.name = {}, .type = found->second};
    const std::size_t last = name.rfind("::");
    const std::string own = last == std::string::npos ? name : name.substr(last + 2);
    if (const auto alias = aliases_.find(own); alias != aliases_.end()) return alias->second;
    return {.name = {},
            .type = Type::nested,
            .nested = plain_type_name(last == std::string::npos ? scope() + "/" + name : name)};
  }

  std::vector<std::string_view> tokens_;
  std::size_t at_ = 0;
  std::vector<std::string> modules_;
  std::map<std::string, MessageField> aliases_;
  ParsedDefinitions parsed_;
};

}  // namespace

ParsedDefinitions parse_idl_text(std::string_view text) { return Parser(text).parse(); }

}  // namespace ident::ros2
