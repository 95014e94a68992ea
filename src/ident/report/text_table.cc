// Lays a table out in lines of equal-width characters.
#include "ident/report/text_table.h"

#include <algorithm>
#include <numeric>
#include <sstream>

namespace ident {
namespace {

constexpr int kGap = 2;           // blanks between columns
constexpr int kLongestWord = 28;  // a longer one (the name of a file) may be broken
constexpr std::size_t kLongestNumberTable =
    32;  // bytes; what is longer and starts with a digit is a sentence

/// Where the decimal point stands, or where it would.
std::size_t point_of(std::string_view cell) {
  const auto end = cell.find_first_not_of("+-(0123456789");
  return end == std::string_view::npos ? cell.size() : end;
}

/// The text with blanks in words that no line holds, behind a separator of file names where there is one.
std::string breakable(std::string text, int width) {
  const auto room = static_cast<std::size_t>(std::max(width, 1));
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (display_width(std::string_view(text).substr(at, end - at)) <= width) {
      at = end + 1;
      continue;
    }
    const std::size_t separator = std::string_view(text).substr(at, room).find_last_of("/_-.");
    std::size_t cut = at + (separator == std::string_view::npos || separator == 0 ? room : separator + 1);
    while (cut > at + 1 && (text[cut] & 0xC0) == 0x80) --cut;  // not within a character
    text.insert(cut, 1, ' ');
    at = cut + 1;
  }
  return text;
}

/// A text whose first line has `indent` columns before it already.
std::string wrap_after(const std::string& text, int width, int indent) {
  return wrap(breakable(text, width - indent), width, indent).substr(static_cast<std::size_t>(indent));
}

std::string padded(const std::string& cell, int width) {
  return cell + std::string(static_cast<std::size_t>(std::max(0, width - display_width(cell))), ' ');
}

std::string without_trailing_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::string_view without_leading_blanks(std::string_view cell) {
  return cell.substr(std::min(cell.size(), cell.find_first_not_of(' ')));
}

int widest(const std::vector<std::string>& cells) {
  int width = 0;
  for (const std::string& cell : cells) width = std::max(width, display_width(cell));
  return width;
}

/// The width below which a column cannot be broken: that of its longest word, and of a number as a whole.
int least_width(const std::vector<std::string>& cells) {
  int width = 0;
  for (std::size_t r = 0; r < cells.size(); ++r) {
    const bool whole =
        r > 0 && is_number(without_leading_blanks(cells[r])) && cells[r].size() <= kLongestNumberTable;
    for (std::size_t at = 0; at < cells[r].size();) {
      const std::size_t end = whole ? cells[r].size() : std::min(cells[r].find(' ', at), cells[r].size());
      const int word = display_width(std::string_view(cells[r]).substr(at, end - at));
      width = std::max(width, whole ? word : std::min(word, kLongestWord));
      at = end + 1;
    }
  }
  return width;
}

/// Narrows the widest columns whose cells can be broken until all stand beside each other; false if they
/// cannot.
bool fit(const std::vector<std::vector<std::string>>& columns, std::vector<int>& widths, int width) {
  std::vector<int> least;
  for (const auto& column : columns) least.push_back(std::min(widest(column), least_width(column)));
  const int gaps = kGap * (static_cast<int>(widths.size()) - 1);
  for (;;) {
    if (std::accumulate(widths.begin(), widths.end(), 0) + gaps <= width) return true;
    int next = -1;
    for (int c = 0; c < std::ssize(widths); ++c) {
      const auto at = static_cast<std::size_t>(c);
      if (widths[at] > least[at] && (next < 0 || widths[at] > widths[static_cast<std::size_t>(next)]))
        next = c;
    }
    if (next < 0) return false;
    --widths[static_cast<std::size_t>(next)];
  }
}

std::vector<std::string> lines_of_cell(const std::string& cell, int width) {
  if (display_width(cell) <= width) return {cell};
  std::vector<std::string> lines;
  std::istringstream wrapped(wrap(breakable(cell, width), width));
  for (std::string line; std::getline(wrapped, line);) lines.push_back(line);
  return lines;
}

std::string table_row(const std::vector<std::vector<std::string>>& columns, const std::vector<int>& widths,
                      std::size_t row) {
  std::vector<std::vector<std::string>> cells;
  std::size_t height = 1;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    cells.push_back(lines_of_cell(columns[c][row], widths[c]));
    height = std::max(height, cells.back().size());
  }
  std::string out;
  for (std::size_t i = 0; i < height; ++i) {
    std::string line;
    for (std::size_t c = 0; c < columns.size(); ++c)
      line += padded(i < cells[c].size() ? cells[c][i] : "", widths[c] + kGap);
    out += without_trailing_blanks(line) + "\n";
  }
  return out;
}

/// For what is too wide to stand side by side: each row as a list.
std::string records(const Table& table, int width) {
  const int room = widest(table.columns);
  std::string out;
  for (const auto& row : table.rows) {
    if (!out.empty()) out += "\n";
    for (std::size_t c = 0; c < std::min(row.size(), table.columns.size()); ++c)
      if (!row[c].empty())
        out += padded(table.columns[c], room + kGap) + wrap_after(row[c], width, room + kGap);
  }
  return out;
}

}  // namespace

int display_width(std::string_view text) {
  return static_cast<int>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

bool is_number(std::string_view cell) {
  const auto digit = cell.find_first_of("0123456789");
  return digit != std::string_view::npos && cell.find_first_not_of("+-(") == digit;
}

void align_points(std::vector<std::string>& cells) {
  std::size_t before = 0;
  for (const std::string& cell : cells)
    if (is_number(cell)) before = std::max(before, point_of(cell));
  for (std::string& cell : cells)
    if (is_number(cell)) cell.insert(0, before - point_of(cell), ' ');
}

std::string wrap(std::string_view text, int width, int indent) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  std::string out, line;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string word(text.substr(at, end - at));
    at = end + 1;
    if (word.empty()) continue;
    if (!line.empty() && indent + display_width(line) + 1 + display_width(word) > width) {
      out += margin + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? out : out + margin + line + "\n";
}

std::string text_table(const Table& table, int width) {
  std::vector<std::vector<std::string>> columns(table.columns.size());
  std::vector<int> widths;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (const auto& row : table.rows) columns[c].push_back(c < row.size() ? row[c] : "");
    align_points(columns[c]);
    columns[c].insert(columns[c].begin(), table.columns[c]);
    widths.push_back(widest(columns[c]));
  }
  if (!fit(columns, widths, width)) return records(table, width);
  std::string out;
  for (std::size_t r = 0; r <= table.rows.size(); ++r) out += table_row(columns, widths, r);
  return out;
}

}  // namespace ident
