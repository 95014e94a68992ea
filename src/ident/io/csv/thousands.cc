// Groups of three digits.
#include "ident/io/csv/thousands.h"

#include <algorithm>
#include <array>

namespace ident {
namespace {

// Blank, no-break space, narrow no-break space, apostrophe, typographic apostrophe; comma and point below.
constexpr std::array<std::string_view, 5> kMarks = {" ", "\u00A0", "\u202F", "'", "\u2019"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t digits_at(std::string_view text, std::size_t at) {
  std::size_t n = 0;
  while (at + n < text.size() && is_digit(text[at + n])) ++n;
  return n;
}

struct Groups {
  std::string digits;
  std::size_t count = 0, end = 0;
};

/// Groups from the start of a text; their count is 0 where the mark does not come.
Groups groups_of(std::string_view text, std::string_view mark) {
  Groups found;
  const std::size_t first = digits_at(text, 0);
  if (first < 1 || first > 3 || text.front() == '0') return found;
  found.digits = text.substr(0, first);
  found.end = first;
  while (text.substr(found.end).starts_with(mark) && digits_at(text, found.end + mark.size()) == 3) {
    found.digits += text.substr(found.end + mark.size(), 3);
    found.end += mark.size() + 3;
    ++found.count;
  }
  return found;
}

/// The rest is nothing, or a decimal mark and digits.
std::string with_decimals(const Groups& groups, std::string_view rest, char decimal) {
  if (groups.count == 0) return "";
  if (rest.empty()) return groups.digits;
  if (rest.front() != decimal || digits_at(rest, 1) + 1 != rest.size()) return "";
  return groups.digits + "." + std::string(rest.substr(1));
}

}  // namespace

std::string without_thousands(std::string_view cell, DecimalMark decimal) {
  const bool negative = cell.starts_with('-');
  const std::string_view text = cell.substr(negative ? 1 : 0);
  std::string number;
  const auto take = [&](std::string_view mark, char point) {
    const Groups groups = groups_of(text, mark);
    const std::string_view rest = text.substr(groups.end);
    // A comma or a point is a mark of thousands only beside the other one, twice, or where the file says so.
    const bool may_be_decimal =
        mark == "," ? decimal != DecimalMark::point : mark == "." && decimal != DecimalMark::comma;
    if (number.empty() && !(may_be_decimal && groups.count < 2 && rest.empty()))
      number = with_decimals(groups, rest, point);
  };
  if (!text.empty()) {
    for (const std::string_view mark : kMarks)
      for (const char point : {'.', ','})
        if (!(point == '.' && decimal == DecimalMark::comma) &&
            !(point == ',' && decimal == DecimalMark::point))
          take(mark, point);
    take(",", '.');
    take(".", ',');
  }
  return number.empty() || !negative ? number : "-" + number;
}

}  // namespace ident
