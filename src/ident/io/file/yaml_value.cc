// YAML through yaml-cpp, with numbers read without a locale.
#include "ident/io/file/yaml_value.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"
#include "ident/io/csv/parse_number.h"
#include "ident/io/file/read_bytes.h"

namespace ident {
namespace {

constexpr std::size_t kLargestFile = 16u << 20;

std::vector<YAML::Node> documents(const std::string& path, const std::string& text) {
  try {
    return YAML::LoadAll(text);
  } catch (const YAML::DeepRecursion& error) {
    throw InputError(path, error.mark.line + 1, "", "is nested too deeply");
  } catch (const YAML::Exception& error) {
    throw InputError(path, error.mark.line + 1, "", "is not valid YAML: " + error.msg);
  }
}

std::string child_path(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

}  // namespace

YamlValue::YamlValue(std::string file, std::string path, const YAML::Node& node)
    : file_(std::move(file)), path_(std::move(path)), node_(node) {}

long YamlValue::line() const { return node_.Mark().line + 1; }

void YamlValue::fail(std::string_view what) const { throw InputError(file_, line(), path_, what); }

double YamlValue::number() const {
  if (!node_.IsScalar()) fail(node_.IsNull() ? "has no value" : "has to be a number");
  const std::optional<double> value = parse_number(node_.Scalar());
  if (!value) fail(fmt::format("'{}' is not a number", node_.Scalar()));
  if (!std::isfinite(*value)) fail(fmt::format("'{}' is not finite", node_.Scalar()));
  return *value;
}

double YamlValue::positive_number() const {
  const double value = number();
  if (value <= 0.0) fail("has to be positive");
  return value;
}

std::array<double, 3> YamlValue::vector3() const {
  const std::vector<YamlValue> cells = list();
  if (cells.size() != 3) fail(fmt::format("has {} numbers instead of 3", cells.size()));
  return {cells[0].number(), cells[1].number(), cells[2].number()};
}

std::string YamlValue::text() const {
  if (!node_.IsScalar()) fail(node_.IsNull() ? "has no value" : "has to be a word or text");
  return node_.Scalar();
}

std::vector<YamlValue> YamlValue::list() const {
  if (!node_.IsSequence()) fail("has to be a list, [..]");
  std::vector<YamlValue> values;
  for (std::size_t i = 0; i < node_.size(); ++i)
    values.emplace_back(file_, fmt::format("{}[{}]", path_, i + 1), node_[i]);
  return values;
}

void YamlValue::expect_map() const {
  if (!node_.IsMap()) fail(node_.IsNull() ? "has no value" : "has to be a mapping, 'key: value'");
  std::set<std::string> seen;
  for (const auto& pair : node_) {
    const YamlValue key(file_, path_, pair.first);
    if (!pair.first.IsScalar()) key.fail("a key has to be a word");
    const std::string name = pair.first.Scalar();
    if (!seen.insert(name).second)
      throw InputError(file_, key.line(), child_path(path_, name), "stands there twice");
  }
}

void YamlValue::expect_map(std::span<const std::string> keys) const {
  expect_map();
  for (const auto& pair : node_) {
    const std::string name = pair.first.Scalar();
    if (std::ranges::find(keys, name) == keys.end())
      throw InputError(file_, pair.first.Mark().line + 1, child_path(path_, name),
                       "is not a key that is known here" + did_you_mean(name, keys));
  }
}

bool YamlValue::has(const std::string& key) const { return node_.IsMap() && node_[key].IsDefined(); }

YamlValue YamlValue::at(const std::string& key) const {
  if (!has(key)) fail(fmt::format("'{}' is missing", key));
  return {file_, child_path(path_, key), node_[key]};
}

std::vector<std::string> YamlValue::keys() const {
  std::vector<std::string> names;
  for (const auto& pair : node_) names.push_back(pair.first.Scalar());
  return names;
}

YamlValue load_yaml(const std::string& path) { return load_yaml(path, read_bytes(path, kLargestFile)); }

YamlValue load_yaml(const std::string& path, const std::string& text) {
  const std::vector<YAML::Node> all = documents(path, text);
  if (all.empty() || all.front().IsNull()) throw InputError(path, 0, "", "is empty");
  if (all.size() > 1) throw InputError(path, 0, "", "holds more than one YAML document");
  return {path, "", all.front()};
}

}  // namespace ident
