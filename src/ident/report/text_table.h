// Tables for a terminal: columns padded to equal width, numbers aligned on the decimal point.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ident/result/result.h"

namespace ident {

/// Columns on the screen that a UTF-8 text takes, one a code point.
int display_width(std::string_view text);

/// Breaks a text at blanks into lines of at most `width` columns, each after `indent` blanks.
std::string wrap(std::string_view text, int width, int indent = 0);

/// True for what starts like a number: "-0.5 %", "(6.0 ± 0.1)e-6".
bool is_number(std::string_view cell);

/// Pads the numbers among the cells of a column on the left, so that their points stand under each other.
void align_points(std::vector<std::string>& cells);

/// Numbers in a column are aligned on the decimal point. Where the table would exceed `width`, heads and
/// texts are wrapped; what is too wide even then is written as a list for each row.
std::string text_table(const Table& table, int width);

}  // namespace ident
