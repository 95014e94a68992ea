// Are the columns of a quaternion what their names say?
#pragma once

#include <string>

#include "ident/data/flight_log.h"

namespace ident {

/// Quaternion and rates in the file's own frames, before any is turned. Throws InputError where the attitude
/// turns with the rates only if its components are read in the other order, scalar last or first; warns
/// (`wrong_frame`) where it does only as that of the world in the body.
void check_quaternion(FlightLog& log, long header_line);

}  // namespace ident
