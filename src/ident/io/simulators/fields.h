// What a simulator's file states: named numbers with their places in the text, so that they can be replaced
// there.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ident {

/// A number as it stands in the text.
struct FieldNumber {
  double value = 0.0;
  std::size_t begin = 0, size = 0;
};

/// One or several numbers, or a word, under a name of the format.
struct Field {
  std::vector<FieldNumber> numbers;
  std::string text;  ///< as it stands there
  std::size_t begin = 0, size = 0;
  long line = 0;
  std::string elsewhere;    ///< another file that it stands in: nothing to patch here
  bool computed = false;    ///< an expression: only the whole can be replaced
  std::string open, close;  ///< what stands around several numbers that replace an expression
};

/// Where a field that the file lacks would stand.
struct Insertion {
  std::size_t at = 0;
  std::string before, after;  ///< around the numbers
  double absent = 0.0;        ///< what the simulator takes where there is none
};

/// All fields of a file. Every error names the file and the line.
class Fields {
 public:
  Fields(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}

  const std::string& text() const { return text_; }
  const std::string& file() const { return file_; }
  long line_at(std::size_t offset) const;

  void add(const std::string& name, Field field) { fields_.insert_or_assign(name, std::move(field)); }
  /// A field whose numbers stand in text[begin, begin + size), apart from blanks, commas and brackets.
  /// Throws InputError when something there is no finite number.
  void add_numbers(const std::string& name, std::size_t begin, std::size_t size);
  void add_word(const std::string& name, std::size_t begin, std::size_t size);
  void can_insert(const std::string& name, Insertion where) { insertions_[name] = std::move(where); }

  bool has(const std::string& name) const { return fields_.count(name) > 0; }
  const Field& at(const std::string& name) const;  ///< throws InputError when it is missing
  const Insertion* insertion(const std::string& name) const;
  double number(const std::string& name) const;
  double number(const std::string& name, double otherwise) const;
  double positive(const std::string& name) const;
  std::string word(const std::string& name, const std::string& otherwise) const;
  Eigen::Vector3d vector3(const std::string& name) const;
  std::vector<double> numbers(const std::string& name, std::size_t count) const;
  const std::map<std::string, Field>& all() const { return fields_; }

  [[noreturn]] void fail(const std::string& name, std::string_view what) const;

 private:
  std::string text_, file_;
  std::map<std::string, Field> fields_;
  std::map<std::string, Insertion> insertions_;
};

}  // namespace ident
