// Finds the assignments of a Python file; what stands behind them is the parser's.
#include "ident/io/simulators/readers/python_literal.h"

#include <cctype>

#include "ident/core/error.h"
#include "ident/io/simulators/readers/python_parser.h"

namespace ident {
namespace {

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
  std::map<std::string, PythonValue> names;
  std::string found;
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t value = assignment(text, line, found);
    if (value != std::string::npos && found == name) {
      PythonParser(fields, names, value).dictionary("");
      return fields;
    }
    if (value != std::string::npos) {
      try {
        names[found] = PythonParser(fields, names, value).expression();
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
