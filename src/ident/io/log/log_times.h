// The time stamps of a log's rows, put in order.
#pragma once

#include <vector>

#include "ident/data/table.h"

namespace ident {

/// Drops rows whose time goes back and puts together those of one time. Returns the times after which the
/// clock was set back. Throws InputError where too many go back.
std::vector<double> put_time_in_order(NumberTable& table);

/// Seconds since 1970 leave a double too few digits for what lies between two rows: then times, those of
/// `breaks` too, count from the first whole second. Returns that, else 0.
double count_from_begin(NumberTable& table, std::vector<double>& breaks);

}  // namespace ident
