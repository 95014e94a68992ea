// How a table is written: separator, decimal mark, encoding; found out from its first lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ident {

enum class DecimalMark { unknown, point, comma };

struct CsvDialect {
  char separator = ',';  ///< ' ' stands for any number of blanks or tabs
  DecimalMark decimal = DecimalMark::unknown;
  bool latin1 = false;
};

/// The dialect that explains best the header and the lines after it.
CsvDialect sniff_dialect(const std::string& header, const std::vector<std::string>& lines);

/// Cells of a line, without blanks and quotes around them; they point into `line`. False: a quote is not
/// closed.
bool split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells);

/// "semicolon", for notices.
std::string_view separator_name(char separator);

/// Whether a cell is a number, with a decimal point or a decimal comma.
bool looks_like_number(std::string_view cell);

}  // namespace ident
