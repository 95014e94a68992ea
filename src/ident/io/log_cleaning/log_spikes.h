// Values in a log that cannot belong to the flight.
#pragma once

#include <string>

#include "ident/io/log_cleaning/log_checks.h"

namespace ident {

/// Makes single samples NaN that lie far off the four around them, which agree (warning `spikes`): a bit that
/// fell over on the way to the log. So are some in a row that come and go at once within a hundredth of a
/// second, which no rotor does to a vehicle. None where they are too many for that.
void drop_spikes(FlightLog& log, Components sensor, const std::string& name);

/// The same for commands, which may well jump for one sample: only values a hundred times larger than all but
/// a hundredth of them.
void drop_impossible(FlightLog& log, Components commands, const std::string& name);

}  // namespace ident
