// A recursive descent over expressions that give numbers or arrays of numbers.
#include "ident/io/simulators/readers/python_literal.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <functional>
#include <numbers>

#include "ident/core/error.h"
#include "ident/io/csv/parse_number.h"

namespace ident {
namespace {

constexpr int kDeepest = 100;

/// A number or an array, and the places of its numbers as long as they are literals.
struct Evaluated {
  std::vector<double> v;
  std::vector<FieldNumber> places;
  bool literal = true, array = false;
};

class Parser {
 public:
  Parser(Fields& fields, std::map<std::string, Evaluated>& names, std::size_t at)
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

  Evaluated expression() {
    if (++depth_ > kDeepest) fail("is nested too deeply");
    Evaluated left = product();
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
    if (!accept(c)) fail(peek() == '\0' ? fmt::format("the file ends where '{}' is missing", c)
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
    Evaluated value = expression();
    std::size_t end = at_;
    Field field{.text = text_.substr(begin, end - begin), .begin = begin, .size = end - begin,
                .line = fields_.line_at(begin), .computed = !value.literal};
    if (value.array) field.open = "np.array([", field.close = "])";
    for (std::size_t i = 0; i < value.v.size(); ++i) {
      if (!std::isfinite(value.v[i])) fail("is not finite");
      field.numbers.push_back(value.literal ? value.places[i] : FieldNumber{value.v[i], begin, end - begin});
    }
    if (field.numbers.empty()) return;
    fields_.add(path, std::move(field));
  }

  Evaluated product() {
    Evaluated left = power();
    for (;;) {
      if (accept('*'))
        left = combined(left, power(), std::multiplies<>());
      else if (accept('/'))
        left = combined(left, power(), std::divides<>());
      else
        return left;
    }
  }
  Evaluated power() {
    if (++depth_ > kDeepest) fail("is nested too deeply");
    Evaluated base = unary();
    if (accept_power()) base = combined(base, power(), [](double a, double b) { return std::pow(a, b); });
    --depth_;
    return base;
  }
  Evaluated unary() {
    const char next = peek();
    const std::size_t begin = at_;
    if (next != '-' && next != '+') return atom();
    if (++depth_ > kDeepest) fail("is nested too deeply");
    ++at_;
    Evaluated value = unary();
    --depth_;
    const double sign = next == '-' ? -1.0 : 1.0;
    for (double& x : value.v) x *= sign;
    if (value.literal && value.v.size() == 1 && !value.array)
      value.places[0] = {value.v[0], begin, value.places[0].begin + value.places[0].size - begin};
    else
      value.literal = false;
    return value;
  }
  Evaluated atom() {
    const char next = peek();
    if (next == '(' || next == '[') return list(next == '(' ? ')' : ']');
    if (std::isdigit(static_cast<unsigned char>(next)) || next == '.') return literal();
    if (std::isalpha(static_cast<unsigned char>(next)) || next == '_') return name();
    fail(next == '\0' ? std::string("the file ends where a value is missing")
                      : fmt::format("'{}' is no value that is understood here", next));
  }
  Evaluated literal() {
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
  Evaluated list(char closing) {
    if (++depth_ > kDeepest) fail("is nested too deeply");
    ++at_;
    Evaluated all;
    bool comma = false;
    while (peek() != closing) {
      Evaluated one = expression();
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
  Evaluated name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_' || text_[at_] == '.'))
      ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    if (const auto known = names_.find(word); known != names_.end()) {
      Evaluated value = known->second;
      value.literal = false;
      return value;
    }
    if (word == "np.pi" || word == "numpy.pi" || word == "math.pi") return {{std::numbers::pi}, {}, false};
    if (word == "True" || word == "False") return {{word == "True" ? 1.0 : 0.0}, {}, false};
    const std::string function = word.substr(word.find('.') == std::string::npos ? 0 : word.find('.') + 1);
    static const std::map<std::string, double (*)(double)> functions = {
        {"sqrt", [](double x) { return std::sqrt(x); }}, {"sin", [](double x) { return std::sin(x); }},
        {"cos", [](double x) { return std::cos(x); }},
        {"deg2rad", [](double x) { return x * std::numbers::pi / 180.0; }},
        {"radians", [](double x) { return x * std::numbers::pi / 180.0; }}};
    if (peek() == '(' && (function == "array" || function == "asarray")) {
      ++at_;
      Evaluated inner = expression();
      accept(',');
      expect(')');
      inner.array = true;
      return inner;
    }
    if (const auto f = functions.find(function); f != functions.end() && peek() == '(') {
      Evaluated inner = list(')');
      for (double& x : inner.v) x = f->second(x);
      inner.literal = false, inner.array = inner.v.size() > 1;
      return inner;
    }
    fail(fmt::format("'{}' is not understood: only numbers, arithmetic and np.array are", word));
  }
  template <class Operation>
  Evaluated combined(const Evaluated& a, const Evaluated& b, Operation operation) {
    if (a.v.size() != b.v.size() && a.v.size() != 1 && b.v.size() != 1) fail("joins arrays of different length");
    Evaluated out{.literal = false, .array = a.array || b.array};
    for (std::size_t i = 0; i < std::max(a.v.size(), b.v.size()); ++i)
      out.v.push_back(operation(a.v[a.v.size() == 1 ? 0 : i], b.v[b.v.size() == 1 ? 0 : i]));
    return out;
  }

  Fields& fields_;
  const std::string& text_;
  std::map<std::string, Evaluated>& names_;
  std::size_t at_;
  std::string where_;
  int depth_ = 0;
};

/// Where the value of an assignment at the start of a line begins, and the name; npos where there is none.
std::size_t assignment(std::string_view text, std::size_t line, std::string& name) {
  std::size_t at = line;
  while (at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_')) ++at;
  name = std::string(text.substr(line, at - line));
  at = text.find_first_not_of(" \t", at);
  if (name.empty() || at == std::string_view::npos || text[at] != '=' || text.substr(at, 2) == "==")
    return std::string_view::npos;
  return at + 1;
}

}  // namespace

bool assigns_dictionary(std::string_view text, std::string_view name) {
  std::string found;
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t value = assignment(text, line, found);
    if (value != std::string_view::npos && found == name) {
      const std::size_t first = text.find_first_not_of(" \t\r\n\\", value);
      return first != std::string_view::npos && text[first] == '{';
    }
    const std::size_t end = text.find('\n', line);
    if (end == std::string_view::npos) break;
    line = end + 1;
  }
  return false;
}

Fields python_literal(const std::string& text, const std::string& file, const std::string& name) {
  Fields fields(text, file);
  std::map<std::string, Evaluated> names;
  std::string found;
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t value = assignment(text, line, found);
    if (value != std::string::npos && found == name) {
      Parser(fields, names, value).dictionary("");
      return fields;
    }
    if (value != std::string::npos) {
      try {
        names[found] = Parser(fields, names, value).expression();
      } catch (const InputError&) {  // of a name that is not used, perhaps; told where it is
        names.erase(found);
      }
    }
    const std::size_t end = text.find('\n', line);
    if (end == std::string::npos) break;
    line = end + 1;
  }
  throw InputError(file, 0, name, "is not assigned in this file");
}

}  // namespace ident
