// Chosen columns of a table as numbers in SI units.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ident/data/table.h"
#include "ident/io/csv/csv_reader.h"

namespace ident {

/// A column to read, and what it becomes: unit * (scale * number + offset).
struct ChosenColumn {
  std::string name;  ///< canonical signal
  std::size_t index = 0;
  double unit = 1.0, scale = 1.0, offset = 0.0;
  bool is_time = false;      ///< may hold clock times
  bool is_fraction = false;  ///< `40%` is 0.4, whatever the unit of the column
};

/// A column of words, read as it stands.
struct ChosenText {
  std::string name;
  std::size_t index = 0;
  std::vector<std::string> words;  ///< what may stand there, lower case
};

/// Reads all rows. Clock times become seconds from the first row. Throws InputError `file:line: column:
/// what`.
NumberTable read_columns(const std::string& path, CsvReader& csv, const std::vector<ChosenColumn>& columns,
                         const std::vector<ChosenText>& text);

}  // namespace ident
