// Flattens TOML tables; toml++ tells line and column of each value, columns in characters.
#include "ident/io/simulators/readers/toml_fields.h"

#include <toml++/toml.h>

#include <cmath>

#include "ident/core/error.h"

namespace ident {
namespace {

toml::table parsed(const std::string& text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError(file, static_cast<long>(error.source().begin.line), "",
                     "is not valid TOML: " + std::string(error.description()));
  }
}

class Flattening {
 public:
  explicit Flattening(Fields& fields) : fields_(fields) {
    starts_.push_back(0);
    for (std::size_t i = 0; i < fields.text().size(); ++i)
      if (fields.text()[i] == '\n') starts_.push_back(i + 1);
  }

  void table(const toml::table& table, const std::string& path) {
    for (const auto& [key, node] : table) {
      const std::string name = path.empty() ? std::string(key.str()) : path + "." + std::string(key.str());
      if (const toml::table* inner = node.as_table())
        this->table(*inner, name);
      else
        entry(node, name);
    }
  }

 private:
  std::size_t offset(const toml::source_position& at) const {
    std::size_t i = starts_.at(std::min<std::size_t>(at.line, starts_.size()) - 1);
    for (toml::source_index column = 1; column < at.column && i < fields_.text().size(); ++column) do
        ++i;
      while (i < fields_.text().size() && (static_cast<unsigned char>(fields_.text()[i]) & 0xC0U) == 0x80U);
    return i;
  }

  bool numbers(const toml::node& node, const std::string& name, Field& field) const {
    if (const toml::array* list = node.as_array()) {
      for (const toml::node& child : *list)
        if (!numbers(child, name, field)) return false;
      return true;
    }
    const std::optional<double> value = node.value<double>();
    if (!value || !node.is_number()) return false;
    if (!std::isfinite(*value))
      throw InputError(fields_.file(), static_cast<long>(node.source().begin.line), name, "is not finite");
    const std::size_t begin = offset(node.source().begin);
    field.numbers.push_back({*value, begin, offset(node.source().end) - begin});
    return true;
  }

  void entry(const toml::node& node, const std::string& name) {
    Field field{.line = static_cast<long>(node.source().begin.line)};
    if (!numbers(node, name, field) || field.numbers.empty()) {
      if (const auto word = node.value<std::string>())
        field.text = *word, field.numbers.clear(), fields_.add(name, field);
      return;
    }
    field.begin = field.numbers.front().begin;
    field.size = field.numbers.back().begin + field.numbers.back().size - field.begin;
    fields_.add(name, std::move(field));
  }

  Fields& fields_;
  std::vector<std::size_t> starts_;
};

}  // namespace

Fields toml_fields(const std::string& text, const std::string& file) {
  Fields fields(text, file);
  Flattening(fields).table(parsed(text, file), "");
  return fields;
}

std::vector<std::string> toml_tables(const std::string& text, const std::string& file) {
  std::vector<std::string> names;
  for (const auto& [key, node] : parsed(text, file))
    if (node.is_table()) names.emplace_back(key.str());
  return names;
}

}  // namespace ident
