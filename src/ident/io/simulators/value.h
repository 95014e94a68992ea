// One entry that a simulator's file takes from a vehicle: its name there, its numbers, and what they come
// from.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ident {

struct Value {
  std::string name;  ///< that of the format, as `Fields` has it
  std::vector<double> numbers;
  std::string unit;
  std::string of;                     ///< constants of the vehicle that make it: "kQ/kT"
  std::string word = {};              ///< instead of numbers
  std::optional<double> absent = {};  ///< what the simulator takes where a file has no such entry
};

/// The entries of one file with their uncertainty, for its author.
class Values {
 public:
  explicit Values(std::vector<Value> values) : values_(std::move(values)) {}

  const std::vector<Value>& all() const { return values_; }
  const Value& at(const std::string& name) const;
  double number(const std::string& name) const { return at(name).numbers.front(); }
  /// Numbers as text, the shortest that reads back to 15 digits.
  std::string text(const std::string& name, const std::string& separator = " ") const;
  /// "kg; 95 % [0.498, 0.502]; m of falcon.yaml", for a comment.
  std::string note(const std::string& name) const;
  /// The 95 % interval of an entry with one number; both ends are the number where nothing is known of it.
  std::pair<double, double> interval(const std::string& name) const;

  std::vector<double> deviations;  ///< of the first number of each entry; 0: not known
  std::string source;              ///< the vehicle's file or name

 private:
  std::size_t index(const std::string& name) const;
  std::vector<Value> values_;
};

/// A number with at most 15 significant digits.
std::string value_text(double number);

/// A number of a file rounded to 13 digits: what rounding of a quotient leaves behind is no information, and
/// what was exported is read back as the same double.
double as_stated(double number);

}  // namespace ident
