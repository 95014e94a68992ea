// A map of a bench file: which column is which signal, in which unit.
//
//     columns:
//       omega: {column: Speed, unit: rpm}
//       thrust: {column: Load cell 1, unit: gf, scale: -1}
#pragma once

#include <map>
#include <string>

#include "ident/io/csv/read_table.h"

namespace ident {

/// Where a signal stands: unit times (scale * number + offset).
struct TableColumn {
  std::string column;
  std::string unit;  ///< of the scaled number; empty: that of the header, else the signal's own
  double scale = 1.0, offset = 0.0;
  long line = 0;  ///< in the map file
};

struct TableMap {
  std::string file;
  std::map<std::string, TableColumn> columns;  ///< by signal; others are found under their own names
};

/// Reads a map. Throws InputError, also for a name that is no signal of the schema.
TableMap read_table_map(const std::string& path, const TableSchema& schema);

}  // namespace ident
