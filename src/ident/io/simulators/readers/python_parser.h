// A recursive descent over Python expressions that give numbers or arrays of numbers. Only python_literal.cc
// includes it.
#pragma once

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "ident/core/error.h"
#include "ident/core/parse_number.h"
#include "ident/io/simulators/fields.h"

namespace ident {

inline constexpr int kDeepestExpression = 100;

/// A number or an array, and the places of its numbers as long as they are literals.
struct PythonValue {
  std::vector<double> v;
  std::vector<FieldNumber> places;
  bool literal = true, array = false;
};

class PythonParser {
 public:
  PythonParser(Fields& fields, std::map<std::string, PythonValue>& names, std::size_t at)
      : fields_(fields), text_(fields.text()), names_(names), at_(at) {}

  void dictionary(const std::string& path) {
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted();
      expect(':');
      entry(path.empty() ? key : path + "." + key);
      if (!accept(',')) {
        expect('}');
        return;
      }
    }
  }

  PythonValue expression() {
    if (++depth_ > kDeepestExpression) fail("is nested too deeply");
    PythonValue left = product();
    for (;;) {
      if (accept('+'))
        left = combined(left, product(), std::plus<>());
      else if (accept('-'))
        left = combined(left, product(), std::minus<>());
      else
        break;
    }
    --depth_;
    return left;
  }

 private:
  [[noreturn]] void fail(std::string_view what) {
    throw InputError(fields_.file(), fields_.line_at(at_), where_, what);
  }

  char peek() {
    for (;;) {
      while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
      if (at_ + 1 < text_.size() && text_[at_] == '\\' && text_[at_ + 1] == '\n') {
        at_ += 2;
        continue;
      }
      if (at_ >= text_.size() || text_[at_] != '#') break;
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    }
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c) return false;
    if (c == '*' && at_ + 1 < text_.size() && text_[at_ + 1] == '*') return false;
    ++at_;
    return true;
  }
  bool accept_power() {
    if (peek() != '*' || at_ + 1 >= text_.size() || text_[at_ + 1] != '*') return false;
    at_ += 2;
    return true;
  }
  void expect(char c) {
    if (!accept(c))
      fail(peek() == '\0' ? fmt::format("the file ends where '{}' is missing", c)
                          : fmt::format("'{}' stands where '{}' is expected", peek(), c));
  }
  std::string quoted() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail("a key has to be quoted text");
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string::npos) fail("a quote is not closed");
    const std::string word = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return word;
  }

  void entry(const std::string& path) {
    where_ = path;
    const char next = peek();
    if (fields_.has(path)) fail("stands there twice");
    if (next == '{') return dictionary(path);
    const std::size_t begin = at_;
    if (next == '\'' || next == '"') {
      quoted();
      return fields_.add_word(path, begin + 1, at_ - begin - 2);
    }
    PythonValue value = expression();
    std::size_t end = at_;
    Field field{.text = text_.substr(begin, end - begin),
                .begin = begin,
                .size = end - begin,
                .line = fields_.line_at(begin),
                .computed = !value.literal};
    if (value.array) field.open = "np.array([", field.close = "])";
    for (std::size_t i = 0; i < value.v.size(); ++i) {
      if (!std::isfinite(value.v[i])) fail("is not finite");
      field.numbers.push_back(value.literal ? value.places[i] : FieldNumber{value.v[i], begin, end - begin});
    }
    if (field.numbers.empty()) return;
    fields_.add(path, std::move(field));
  }

  PythonValue product() {
    PythonValue left = power();
    for (;;) {
      if (accept('*'))
        left = combined(left, power(), std::multiplies<>());
      else if (accept('/'))
        left = combined(left, power(), std::divides<>());
      else
        return left;
    }
  }
  PythonValue power() {
    if (++depth_ > kDeepestExpression) fail("is nested too deeply");
    PythonValue base = unary();
    if (accept_power()) base = combined(base, power(), [](double a, double b) { return std::pow(a, b); });
    --depth_;
    return base;
  }
  PythonValue unary() {
    const char next = peek();
    const std::size_t begin = at_;
    if (next != '-' && next != '+') return atom();
    if (++depth_ > kDeepestExpression) fail("is nested too deeply");
    ++at_;
    PythonValue value = unary();
    --depth_;
    const double sign = next == '-' ? -1.0 : 1.0;
    for (double& x : value.v) x *= sign;
    if (value.literal && value.v.size() == 1 && !value.array)
      value.places[0] = {value.v[0], begin, value.places[0].begin + value.places[0].size - begin};
    else
      value.literal = false;
    return value;
  }
  PythonValue atom() {
    const char next = peek();
    if (next == '(' || next == '[') return list(next == '(' ? ')' : ']');
    if (std::isdigit(static_cast<unsigned char>(next)) || next == '.') return literal();
    if (std::isalpha(static_cast<unsigned char>(next)) || next == '_') return name();
    fail(next == '\0' ? std::string("the file ends where a value is missing")
                      : fmt::format("'{}' is no value that is understood here", next));
  }
  PythonValue literal() {
    const std::size_t begin = at_;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      const bool exponent_sign = (c == '+' || c == '-') && at_ > begin && std::tolower(text_[at_ - 1]) == 'e';
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && !exponent_sign) break;
      ++at_;
    }
    const std::string_view token(text_.data() + begin, at_ - begin);
    const std::optional<double> value = parse_number(token);
    if (!value) fail(fmt::format("'{}' is not a number", token));
    return {{*value}, {{*value, begin, at_ - begin}}};
  }
  PythonValue list(char closing) {
    if (++depth_ > kDeepestExpression) fail("is nested too deeply");
    ++at_;
    PythonValue all;
    bool comma = false;
    while (peek() != closing) {
      PythonValue one = expression();
      all.v.insert(all.v.end(), one.v.begin(), one.v.end());
      all.places.insert(all.places.end(), one.places.begin(), one.places.end());
      all.literal = all.literal && one.literal;
      all.array = all.array || one.array;
      if (!accept(',')) break;
      comma = true;
    }
    expect(closing);
    --depth_;
    all.array = all.array || comma || closing == ']';
    if (closing == ')' && !comma) all.literal = false;  // (a + b): only as a whole
    return all;
  }
  PythonValue name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_' || text_[at_] == '.'))
      ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    if (const auto known = names_.find(word); known != names_.end()) {
      PythonValue value = known->second;
      value.literal = false;
      return value;
    }
    if (word == "np.pi" || word == "numpy.pi" || word == "math.pi") return {{std::numbers::pi}, {}, false};
    if (word == "True" || word == "False") return {{word == "True" ? 1.0 : 0.0}, {}, false};
    const std::string function = word.substr(word.find('.') == std::string::npos ? 0 : word.find('.') + 1);
    static const std::map<std::string, double (*)(double)> functions = {
        {"sqrt", [](double x) { return std::sqrt(x); }},
        {"sin", [](double x) { return std::sin(x); }},
        {"cos", [](double x) { return std::cos(x); }},
        {"deg2rad", [](double x) { return x * std::numbers::pi / 180.0; }},
        {"radians", [](double x) { return x * std::numbers::pi / 180.0; }}};
    if (peek() == '(' && (function == "array" || function == "asarray")) {
      ++at_;
      PythonValue inner = expression();
      accept(',');
      expect(')');
      inner.array = true;
      return inner;
    }
    if (const auto f = functions.find(function); f != functions.end() && peek() == '(') {
      PythonValue inner = list(')');
      for (double& x : inner.v) x = f->second(x);
      inner.literal = false, inner.array = inner.v.size() > 1;
      return inner;
    }
    fail(fmt::format("'{}' is not understood: only numbers, arithmetic and np.array are", word));
  }
  template <class Operation>
  PythonValue combined(const PythonValue& a, const PythonValue& b, Operation operation) {
    if (a.v.size() != b.v.size() && a.v.size() != 1 && b.v.size() != 1)
      fail("joins arrays of different length");
    PythonValue out{.literal = false, .array = a.array || b.array};
    for (std::size_t i = 0; i < std::max(a.v.size(), b.v.size()); ++i)
      out.v.push_back(operation(a.v[a.v.size() == 1 ? 0 : i], b.v[b.v.size() == 1 ? 0 : i]));
    return out;
  }

  Fields& fields_;
  const std::string& text_;
  std::map<std::string, PythonValue>& names_;
  std::size_t at_;
  std::string where_;
  int depth_ = 0;
};

}  // namespace ident
