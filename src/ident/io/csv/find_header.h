// Where a table begins in a file whose first lines are a title, a date, settings of the stand.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ident {

/// Index of the header among the first lines of a file: the first one, unless its width is another than that
/// of the rows and a later line of words has the width of the row of numbers below it.
std::size_t find_header(const std::vector<std::string>& lines);

/// Index of the first line with `width` cells, a number among them; the number of lines where there is none.
std::size_t find_first_row(const std::vector<std::string>& lines, std::size_t width);

}  // namespace ident
