// Cells to numbers, with a count of everything that is no plain number.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ident/io/csv/csv_dialect.h"
#include "ident/result/result.h"

namespace ident {

/// Cells that were read, but not as they stand there.
struct OddCells {
  long count = 0, first_line = 0;
  std::string first_column;
};

/// Reads the cells of one file. An empty cell and a word for "no value" are NaN, an infinite or overflowing
/// one too.
class CellNumbers {
 public:
  explicit CellNumbers(CsvDialect dialect) : dialect_(dialect) {}

  /// The number in a cell; empty when it is none. A decimal comma is understood unless points came before,
  /// and so are marks of thousands where they cannot be decimal marks.
  std::optional<double> read(std::string_view cell, const std::string& column, long line);
  /// Seconds of a time of day, with or without a date, from the midnight before the first one.
  std::optional<double> read_clock(std::string_view cell);

  /// Whether the cell that was read last had marks of thousands.
  bool had_thousands() const { return had_thousands_; }
  bool used_decimal_comma() const { return dialect_.decimal == DecimalMark::comma; }
  /// Warnings `nan_cells`, `infinite_cells`, `tiny_numbers`.
  std::vector<Warning> warnings(const std::string& file) const;

 private:
  std::optional<double> parse(std::string_view cell);

  CsvDialect dialect_;
  bool had_thousands_ = false;
  OddCells nan_, infinite_, tiny_;
  std::optional<long> first_day_;
};

}  // namespace ident
