// YAML values whose errors name file, line and key. Only the files of this folder include it.
#pragma once

#include <yaml-cpp/yaml.h>

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ident {

/// A value in a YAML file and the way to it ("rotors[2].axis").
class YamlValue {
 public:
  YamlValue(std::string file, std::string path, const YAML::Node& node);

  bool is_null() const { return node_.IsNull(); }
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_text() const { return node_.IsScalar(); }
  const std::string& file() const { return file_; }
  const std::string& path() const { return path_; }
  long line() const;

  /// A finite number; `1,5` and words are errors.
  double number() const;
  double positive_number() const;
  std::array<double, 3> vector3() const;
  std::string text() const;
  std::vector<YamlValue> list() const;

  /// Throws when this is no mapping, when a key stands in it twice or is not one of `keys`.
  void expect_map(std::span<const std::string> keys) const;
  /// Same for a mapping with any keys.
  void expect_map() const;
  bool has(const std::string& key) const;
  /// The value of a key; throws when there is none.
  YamlValue at(const std::string& key) const;
  std::vector<std::string> keys() const;

  [[noreturn]] void fail(std::string_view what) const;

 private:
  std::string file_, path_;
  YAML::Node node_;
};

/// The one document of a YAML file; throws InputError.
YamlValue load_yaml(const std::string& path);
/// The same of a text that was read already; `path` is for messages.
YamlValue load_yaml(const std::string& path, const std::string& text);

}  // namespace ident
