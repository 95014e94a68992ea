// A log whose columns were logged too late or too early, read at the right time.
#pragma once

#include <vector>

#include "ident/data/flight_log.h"

namespace ident {

/// Samples of a column at times `t` as they were `seconds` later, at the rows that had one; NaN where there
/// is nothing to interpolate between.
void read_later(const std::vector<double>& t, std::vector<double>& column, double seconds);

/// The same of the attitude.
void read_attitude_later(FlightLog& log, double seconds);

}  // namespace ident
