// Lays a table out in lines of equal-width characters.
#include "ident/report/text_table.h"

#include <algorithm>

namespace ident {
namespace {

constexpr int kGap = 2;  // blanks between columns

/// Where the decimal point stands, or where it would.
std::size_t point_of(std::string_view cell) {
  const auto end = cell.find_first_not_of("+-(0123456789");
  return end == std::string_view::npos ? cell.size() : end;
}

std::string padded(const std::string& cell, int width) {
  return cell + std::string(static_cast<std::size_t>(std::max(0, width - display_width(cell))), ' ');
}

std::string without_trailing_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
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
  const std::size_t columns = table.columns.size();
  std::vector<std::vector<std::string>> cells(columns);
  std::vector<int> widths(columns, 0);
  for (std::size_t c = 0; c < columns; ++c) {
    for (const auto& row : table.rows) cells[c].push_back(c < row.size() ? row[c] : "");
    align_points(cells[c]);
    widths[c] = display_width(table.columns[c]);
    for (const std::string& cell : cells[c]) widths[c] = std::max(widths[c], display_width(cell));
  }
  int before_last = 0;
  for (std::size_t c = 0; c + 1 < columns; ++c) before_last += widths[c] + kGap;

  const auto line_of = [&](auto cell_at) {
    std::string line;
    for (std::size_t c = 0; c + 1 < columns; ++c) line += padded(cell_at(c), widths[c] + kGap);
    if (columns == 0) return line + "\n";
    const std::string last = cell_at(columns - 1);
    if (before_last + display_width(last) <= width || before_last + 20 > width)
      return without_trailing_blanks(line + last) + "\n";
    const std::string wrapped = wrap(last, width, before_last);
    return line + wrapped.substr(static_cast<std::size_t>(before_last));
  };
  std::string out = line_of([&](std::size_t c) { return table.columns[c]; });
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    out += line_of([&](std::size_t c) { return cells[c][r]; });
  return out;
}

}  // namespace ident
