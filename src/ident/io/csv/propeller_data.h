// Static propeller data as coefficients: the files of the UIUC propeller data base.
#pragma once

#include <optional>
#include <string>

#include "ident/data/table.h"
#include "ident/io/csv/csv_reader.h"

namespace ident {

/// A file with RPM, CT and CP as omega, thrust and torque at an air density of 1.225 kg/m^3; nothing for any
/// other header. Diameter and pitch stand in the file's name (ance_8.5x6_static.txt: inches). Throws
/// InputError.
std::optional<NumberTable> read_propeller_data(const std::string& path, CsvReader& csv);

}  // namespace ident
