// What an estimator corrects at once: a vehicle that is elsewhere from one sample to the next.
#pragma once

#include <string>

#include "ident/io/log_cleaning/log_checks.h"

namespace ident {

/// For attitude, velocity or position, which no vehicle changes at once: between a jump and one back within a
/// second samples count as none (warning `spikes`); at every other jump the flight is split, as if it were
/// another one from there on (warning `jumps`). None where they are too many for that.
void split_at_jumps(FlightLog& log, Components sensor, const std::string& name);

}  // namespace ident
