// Checks of a table that was read: required columns, plausible units, time that runs forward.
#pragma once

#include <string>
#include <vector>

#include "ident/data/table.h"
#include "ident/io/csv/read_table.h"

namespace ident {

/// Throws InputError when a required column is missing from `header`; names those that are there.
void expect_columns(const std::string& path, long line, const std::vector<std::string>& header,
                    const std::vector<std::string>& found, const TableSchema& schema);

/// Removes columns without any value (warning `empty_column`); throws DataError when a required one is among
/// them.
void drop_empty_columns(NumberTable& table, const TableSchema& schema);

/// Throws InputError when a column's magnitude shows that its unit is another one.
void expect_plausible(const NumberTable& table, const TableSchema& schema, long header_line);

/// What was wrong with the time stamps. `keep` are the rows that remain, in order.
struct TimeOrder {
  std::vector<std::size_t> keep;
  long backward = 0, repeated = 0, missing = 0;
  long first_backward = 0, first_repeated = 0, first_missing = 0;  ///< lines
  std::vector<double>
      breaks;  ///< times after which the clock was set back: what follows does not go on from there
};

/// Rows whose time is known and not before an earlier one. Throws InputError where too many go back.
TimeOrder time_order(const std::string& path, const std::vector<double>& t, const std::vector<long>& line);

/// Warnings `time_backward`, `time_repeated`, `time_missing`.
std::vector<Warning> time_warnings(const std::string& path, const TimeOrder& order);

/// The rows of a table that are named, in that order.
void keep_rows(NumberTable& table, const std::vector<std::size_t>& keep);

}  // namespace ident
