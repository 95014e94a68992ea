// Compares the widths of neighbouring lines under each separator.
#include "ident/io/csv/find_header.h"

#include <algorithm>
#include <string_view>

#include "ident/io/csv/csv_dialect.h"

namespace ident {
namespace {

using Cells = std::vector<std::string_view>;

bool has_number(const Cells& cells) { return std::ranges::any_of(cells, looks_like_number); }

/// Cells of a line under the separator that the two lines suggest.
struct Pair {
  Cells upper, lower;
  char separator = ',';
};

Pair split_pair(const std::string& upper, const std::string& lower) {
  Pair pair{.separator = sniff_dialect(upper, {lower}).separator};
  split_cells(upper, pair.separator, pair.upper);
  split_cells(lower, pair.separator, pair.lower);
  return pair;
}

bool is_header_of(const Pair& pair) {
  return pair.upper.size() > 1 && pair.upper.size() == pair.lower.size() && !has_number(pair.upper) &&
         has_number(pair.lower);
}

}  // namespace

std::size_t find_header(const std::vector<std::string>& lines) {
  for (std::size_t h = 0; h + 1 < lines.size(); ++h) {
    const Pair pair = split_pair(lines[h], lines[h + 1]);
    if (!is_header_of(pair)) continue;
    Cells first;
    split_cells(lines.front(), pair.separator, first);
    return h > 0 && first.size() != pair.upper.size() ? h : 0;
  }
  return 0;
}

std::size_t find_first_row(const std::vector<std::string>& lines, std::size_t width) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& next = lines[std::min(i + 1, lines.size() - 1)];
    const Pair pair = split_pair(lines[i], next);
    if (pair.upper.size() == width && has_number(pair.upper)) return i;
  }
  return lines.size();
}

}  // namespace ident
