// Flattens YAML nodes; yaml-cpp tells where each scalar begins.
#include "ident/io/simulators/readers/yaml_fields.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "ident/core/error.h"
#include "ident/core/parse_number.h"

namespace ident {
namespace {

class Flattening {
 public:
  explicit Flattening(Fields& fields) : fields_(fields) {}

  void mapping(const YAML::Node& node, const std::string& path) {
    for (const auto& pair : node) {
      if (!pair.first.IsScalar()) continue;
      const std::string name = path.empty() ? pair.first.Scalar() : path + "." + pair.first.Scalar();
      if (fields_.has(name))
        throw InputError(fields_.file(), pair.first.Mark().line + 1, name, "stands there twice");
      if (pair.second.IsMap())
        mapping(pair.second, name);
      else
        entry(pair.second, name);
    }
  }

 private:
  static void scalars(const YAML::Node& node, std::vector<YAML::Node>& found) {
    if (node.IsScalar()) found.push_back(node);
    if (node.IsSequence())
      for (const YAML::Node& child : node) scalars(child, found);
  }

  void entry(const YAML::Node& node, const std::string& name) {
    std::vector<YAML::Node> leaves;
    scalars(node, leaves);
    if (leaves.empty()) return;
    Field field{.text = leaves.front().Scalar(), .line = node.Mark().line + 1};
    for (const YAML::Node& leaf : leaves) {
      const std::optional<double> value = parse_number(leaf.Scalar());
      const std::size_t begin = static_cast<std::size_t>(std::max(leaf.Mark().pos, 0)),
                        size = leaf.Scalar().size();
      if (leaf.Tag() == "!" || !value) {  // quoted, or a word
        if (leaves.size() == 1) fields_.add(name, field);
        return;
      }
      if (!std::isfinite(*value))
        throw InputError(fields_.file(), leaf.Mark().line + 1, name,
                         fmt::format("'{}' is not finite", leaf.Scalar()));
      if (fields_.text().compare(begin, size, leaf.Scalar()) != 0)
        throw InputError(fields_.file(), leaf.Mark().line + 1, name, "cannot be placed in the file");
      field.numbers.push_back({*value, begin, size});
    }
    field.begin = field.numbers.front().begin;
    field.size = field.numbers.back().begin + field.numbers.back().size - field.begin;
    fields_.add(name, std::move(field));
  }

  Fields& fields_;
};

}  // namespace

Fields yaml_fields(const std::string& text, const std::string& file, const std::string& inside) {
  Fields fields(text, file);
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::DeepRecursion& error) {
    throw InputError(file, error.mark.line + 1, "", "is nested too deeply");
  } catch (const YAML::Exception& error) {
    throw InputError(file, error.mark.line + 1, "", "is not valid YAML or JSON: " + error.msg);
  }
  if (!root.IsMap()) throw InputError(file, 1, "", "has to be a mapping, 'key: value'");
  if (!inside.empty() && root[inside].IsDefined() && root[inside].IsMap()) root = root[inside];
  Flattening(fields).mapping(root, "");
  return fields;
}

bool yaml_has_keys(std::string_view text, std::initializer_list<const char*> keys,
                   const std::string& inside) {
  for (const char* key : keys)  // cheap, and files of other formats never reach the parser
    if (text.find(key) == std::string_view::npos) return false;
  try {
    YAML::Node root = YAML::Load(std::string(text));
    if (!root.IsMap()) return false;
    if (!inside.empty() && root[inside].IsDefined() && root[inside].IsMap()) root = root[inside];
    for (const char* key : keys)
      if (!root[key].IsDefined()) return false;
    return true;
  } catch (const YAML::Exception&) {
    return text.find_first_not_of(" \t\r\n") != std::string_view::npos &&
           text[text.find_first_not_of(" \t\r\n")] ==
               '{';  // broken JSON with these keys: its reader says where
  }
}

}  // namespace ident
