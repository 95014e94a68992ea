// Flight logs and bench tables as CSV text, with headers that `ident` reads again; numbers free of locale.
#pragma once

#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/data/table.h"
#include "ident/model/vehicle.h"

namespace ident {

/// `full`: digits from which the same number is read back. `plain`: as many as sensors have.
enum class CsvDigits { plain, full };

/// Commands as `u1..` in us where the vehicle has a command range, else `delta1..`. `comments` become lines
/// that start with `#`. What was not sampled is an empty cell.
std::string flight_log_to_csv(const FlightLog& log, const Vehicle& vehicle, CsvDigits digits,
                              const std::vector<std::string>& comments);

/// Columns under their canonical names, text columns first.
std::string table_to_csv(const NumberTable& table, CsvDigits digits,
                         const std::vector<std::string>& comments);

}  // namespace ident
