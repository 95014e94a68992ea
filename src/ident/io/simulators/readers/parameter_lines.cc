// Splits parameter lines; what sets no parameter in capitals is passed over.
#include "ident/io/simulators/readers/parameter_lines.h"

#include <algorithm>
#include <vector>

namespace ident {
namespace {

struct Token {
  std::size_t begin, size;
};

std::vector<Token> tokens(std::string_view line, std::size_t offset) {
  std::vector<Token> found;
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t first = line.find_first_not_of(" \t\r,=", at);
    if (first == std::string_view::npos || line[first] == '#') break;
    const std::size_t last = std::min(line.find_first_of(" \t\r,=", first), line.size());
    found.push_back({offset + first, last - first});
    at = last;
  }
  return found;
}

bool is_name(std::string_view word) {
  const auto allowed = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
  return word.size() > 2 && word[0] >= 'A' && word[0] <= 'Z' && std::ranges::all_of(word, allowed);
}

}  // namespace

Fields parameter_lines(const std::string& text, const std::string& file) {
  Fields fields(text, file);
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::vector<Token> words = tokens(std::string_view(text).substr(start, end - start), start);
    const auto word = [&](std::size_t i) {
      return std::string_view(text).substr(words[i].begin, words[i].size);
    };
    std::size_t i = 0;  // numbers of the vehicle and component, or `param set`, stand before the name
    while (i < words.size() && i < 3 && !is_name(word(i))) ++i;
    if (i + 1 < words.size() && is_name(word(i)))
      fields.add_numbers(std::string(word(i)), words[i + 1].begin, words[i + 1].size);
    else if (i < words.size() && is_name(word(i)) && i > 0 && word(0) == "param")
      fields.add_numbers(std::string(word(i)), words[i].begin + words[i].size, 0);  // fails: no value
    start = end + 1;
  }
  return fields;
}

bool sets_parameter(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const std::size_t line = text.rfind('\n', at) + 1;
    const std::size_t end = at + name.size();
    const bool whole =
        end < text.size() && std::string_view(" \t,=").find(text[end]) != std::string_view::npos;
    if (whole && text.substr(line, at - line).find_first_of("#/<\"'{") == std::string_view::npos) return true;
  }
  return false;
}

}  // namespace ident
