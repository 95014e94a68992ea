// Sniffs separator and decimal mark, and splits lines.
#include "ident/io/csv/csv_dialect.h"

#include <algorithm>
#include <array>

#include "ident/core/parse_number.h"
#include "ident/io/csv/text_encoding.h"

namespace ident {
namespace {

using Cells = std::vector<std::string_view>;

constexpr std::array<char, 4> kSeparators = {'\t', ';', ',', '|'};  // blanks where none of these fits

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view without_quotes(std::string_view cell) {
  return cell.size() >= 2 && cell.front() == '"' && cell.back() == '"' ? cell.substr(1, cell.size() - 2)
                                                                       : cell;
}

void split_at_blanks(std::string_view line, Cells& cells) {
  for (std::size_t at = 0; at < line.size();) {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    cells.push_back(without_quotes(line.substr(at, end - at)));
    at = end;
  }
}

/// Where the cell that starts at `at` ends; npos when its quote stays open.
std::size_t cell_end(std::string_view line, std::size_t at, char separator) {
  const std::size_t first = line.find_first_not_of(' ', at);
  if (first == std::string_view::npos || line[first] != '"')
    return std::min(line.find(separator, at), line.size());
  std::size_t quote = first;
  do {
    quote = line.find('"', quote + 1);
    if (quote == std::string_view::npos) return quote;
    const bool doubled = quote + 1 < line.size() && line[quote + 1] == '"';
    if (!doubled) break;
    ++quote;
  } while (true);
  return std::min(line.find(separator, quote + 1), line.size());
}

/// How many lines have as many cells as the header; a trailing separator too many is no difference.
std::size_t agreeing(const std::string& header, const std::vector<std::string>& lines, char separator) {
  Cells cells;
  split_cells(header, separator, cells);
  const std::size_t expected = cells.size();
  return static_cast<std::size_t>(std::ranges::count_if(lines, [&](const std::string& line) {
    split_cells(line, separator, cells);
    if (cells.size() == expected + 1 && cells.back().empty()) cells.pop_back();
    return cells.size() == expected;
  }));
}

std::size_t width(const std::string& header, char separator) {
  Cells cells;
  split_cells(header, separator, cells);
  return cells.size();
}

char sniff_separator(const std::string& header, const std::vector<std::string>& lines) {
  char best = ' ';
  std::size_t best_agreeing = 0, best_width = 1;
  for (const char separator : kSeparators) {
    const std::size_t columns = width(header, separator);
    if (columns < 2) continue;
    const std::size_t agree = agreeing(header, lines, separator);
    const bool better =
        best == ' ' || agree > best_agreeing || (agree == best_agreeing && columns > best_width);
    if (!better) continue;
    best = separator;
    best_agreeing = agree;
    best_width = columns;
  }
  if (best != ' ') return best;
  return width(header, ' ') > 1 && (lines.empty() || agreeing(header, lines, ' ') > 0) ? ' ' : ',';
}

bool has_decimal_comma(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos || cell.find('.') != std::string_view::npos) return false;
  std::string with_point(cell);
  with_point[comma] = '.';
  return parse_number(with_point).has_value();
}

DecimalMark sniff_decimal(const std::vector<std::string>& lines, char separator) {
  bool comma = false;
  Cells cells;
  for (const std::string& line : lines) {
    split_cells(line, separator, cells);
    for (const std::string_view cell : cells) {
      if (cell.find('.') != std::string_view::npos && parse_number(cell)) return DecimalMark::point;
      comma = comma || (separator != ',' && has_decimal_comma(cell));
    }
  }
  return comma ? DecimalMark::comma : DecimalMark::unknown;
}

}  // namespace

bool split_cells(std::string_view line, char separator, Cells& cells) {
  cells.clear();
  if (separator == ' ') {
    split_at_blanks(line, cells);
    return true;
  }
  for (std::size_t at = 0;;) {
    const std::size_t end = cell_end(line, at, separator);
    if (end == std::string_view::npos) return false;
    cells.push_back(without_quotes(trimmed(line.substr(at, end - at))));
    if (end == line.size()) return true;
    at = end + 1;
  }
}

bool looks_like_number(std::string_view cell) {
  return parse_number(cell).has_value() || has_decimal_comma(cell);
}

CsvDialect sniff_dialect(const std::string& header, const std::vector<std::string>& lines) {
  CsvDialect dialect;
  dialect.separator = sniff_separator(header, lines);
  dialect.decimal = sniff_decimal(lines, dialect.separator);
  dialect.latin1 = !is_utf8(header);
  return dialect;
}

std::string_view separator_name(char separator) {
  switch (separator) {
    case '\t':
      return "tab";
    case ';':
      return "semicolon";
    case '|':
      return "vertical bar";
    case ' ':
      return "blanks";
    default:
      return "comma";
  }
}

}  // namespace ident
