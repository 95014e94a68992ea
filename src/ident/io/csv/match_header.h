// Which column of a file is which signal of a schema.
#pragma once

#include <string>
#include <vector>

#include "ident/io/csv/csv_reader.h"
#include "ident/io/csv/read_columns.h"
#include "ident/io/csv/read_table.h"

namespace ident {

/// The chosen columns of a file.
struct HeaderMatch {
  std::vector<ChosenColumn> columns;
  std::vector<ChosenText> text;
  std::vector<std::string> notices;  ///< ignored columns
};

/// Header without unit, case, and with blanks for underscores: what is compared.
std::string header_key(std::string_view header);

/// A unit may also be the last word of a name that is else unknown: `thrust_gf`. Throws InputError for an
/// unknown unit, for a column that stands there twice and for one that the map names and the file lacks.
HeaderMatch match_header(const std::string& path, const CsvReader& csv, const TableSchema& schema,
                         const TableMap* map = nullptr);

/// Factor to SI of a column: its own unit, else `default_unit`, else SI. Throws InputError.
double column_factor(const std::string& path, long line, const std::string& header, Dimension dimension,
                     const std::string& default_unit);

/// "t, thrust, rpm": the columns of a file, for messages.
std::string column_list(const std::vector<std::string>& header);

}  // namespace ident
