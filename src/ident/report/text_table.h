// Tables for a terminal: columns padded to equal width, numbers aligned on the decimal point.
#pragma once

#include <string>
#include <string_view>

#include "ident/core/result.h"

namespace ident {

/// Columns on the screen that a UTF-8 text takes, one a code point.
int display_width(std::string_view text);

/// Breaks a text at blanks into lines of at most `width` columns, each after `indent` blanks.
std::string wrap(std::string_view text, int width, int indent = 0);

/// A column in which every cell starts with a digit, sign or bracket is aligned on the decimal point.
/// Cells of the last column are wrapped where the table would exceed `width`.
std::string text_table(const Table& table, int width);

}  // namespace ident
