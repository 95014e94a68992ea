// A flight log with the motion that another device recorded: two files of one flight.
#pragma once

#include "ident/data/flight_log.h"

namespace ident {

/// The log with attitude and position (velocity where it has one) of the recording in the place of its own,
/// brought to its clock and to the axes of its body. Parts of the flight that the recording does not show are
/// left out. What was found is a notice. Throws DataError where the two do not fit (match_motion.h).
FlightLog with_motion(FlightLog log, const FlightLog& recording);

}  // namespace ident
