// Which columns of a flight log to read, by their own names or by a map.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ident/io/csv/csv_reader.h"
#include "ident/io/csv/read_columns.h"
#include "ident/io/log/log_signals.h"
#include "ident/io/log/read_flight_log.h"

namespace ident {

struct LogColumns {
  std::vector<ChosenColumn> columns;
  std::vector<std::string> notices;
  int commands = 0, pulses = 0, speeds = 0;  ///< how many deltaN, uN, omegaN there are
  bool time_unit_stated = false;
  long header_line = 0;

  bool has(const std::string& name) const;
};

/// Throws InputError where the map or the log lacks a column, where rotors are missing or too many, and where
/// the log holds nothing to work on.
LogColumns choose_log_columns(const std::string& path, const CsvReader& csv, const Vehicle& vehicle,
                              const std::optional<LogMap>& map, LogContent content = LogContent::flight);

}  // namespace ident
