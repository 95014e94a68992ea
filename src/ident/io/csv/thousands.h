// Marks between thousands: 1,234.5  1'234.5  1 234,5  1.234,5
#pragma once

#include <string>
#include <string_view>

#include "ident/io/csv/csv_dialect.h"

namespace ident {

/// The number without its marks of thousands and with a decimal point; empty where there are no such marks,
/// or where they may be decimal marks instead. Groups have three digits, the first one to three.
std::string without_thousands(std::string_view cell, DecimalMark decimal);

}  // namespace ident
