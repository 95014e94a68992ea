// Numbers in a text by their places.
#include "ident/io/simulators/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/parse_number.h"

namespace ident {
namespace {

constexpr std::string_view kBetween = " \t\r\n,[](){}";

}  // namespace

long Fields::line_at(std::size_t offset) const {
  return 1 +
         std::count(text_.begin(), text_.begin() + static_cast<long>(std::min(offset, text_.size())), '\n');
}

void Fields::add_numbers(const std::string& name, std::size_t begin, std::size_t size) {
  Field field{.text = text_.substr(begin, size), .begin = begin, .size = size, .line = line_at(begin)};
  std::size_t at = begin;
  const std::size_t end = begin + size;
  while (at < end) {
    const std::size_t first = text_.find_first_not_of(kBetween, at);
    if (first >= end) break;
    const std::size_t last = std::min(text_.find_first_of(kBetween, first), end);
    const std::string_view token(text_.data() + first, last - first);
    const std::optional<double> value = parse_number(token);
    if (!value || !std::isfinite(*value))
      throw InputError(file_, line_at(first), name, fmt::format("'{}' is not a finite number", token));
    field.numbers.push_back({*value, first, last - first});
    at = last;
  }
  if (field.numbers.empty()) throw InputError(file_, field.line, name, "has no value");
  add(name, std::move(field));
}

void Fields::add_word(const std::string& name, std::size_t begin, std::size_t size) {
  add(name, {.text = text_.substr(begin, size), .begin = begin, .size = size, .line = line_at(begin)});
}

const Field& Fields::at(const std::string& name) const {
  const auto found = fields_.find(name);
  if (found == fields_.end()) throw InputError(file_, 0, name, "is missing");
  return found->second;
}

const Insertion* Fields::insertion(const std::string& name) const {
  const auto found = insertions_.find(name);
  return found == insertions_.end() ? nullptr : &found->second;
}

void Fields::fail(const std::string& name, std::string_view what) const {
  throw InputError(file_, has(name) ? at(name).line : 0, name, what);
}

double Fields::number(const std::string& name) const { return numbers(name, 1).front(); }

double Fields::number(const std::string& name, double otherwise) const {
  return has(name) ? number(name) : otherwise;
}

double Fields::positive(const std::string& name) const {
  const double value = number(name);
  if (!(value > 0.0)) fail(name, "has to be positive");
  return value;
}

std::string Fields::word(const std::string& name, const std::string& otherwise) const {
  return has(name) ? at(name).text : otherwise;
}

Eigen::Vector3d Fields::vector3(const std::string& name) const {
  const std::vector<double> v = numbers(name, 3);
  return {v[0], v[1], v[2]};
}

std::vector<double> Fields::numbers(const std::string& name, std::size_t count) const {
  const Field& field = at(name);
  if (field.numbers.size() != count)
    fail(name, fmt::format("has {} number{} instead of {}", field.numbers.size(),
                           field.numbers.size() == 1 ? "" : "s", count));
  std::vector<double> values;
  for (const FieldNumber& number : field.numbers) values.push_back(number.value);
  return values;
}

}  // namespace ident
