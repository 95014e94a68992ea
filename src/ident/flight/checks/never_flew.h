// Did the vehicle fly at all, or was it only armed?
#pragma once

#include <string>

#include "ident/data/flight_log.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Why a log is none of a flight, in words: nothing in it moves, and its rotors do not carry the weight.
/// Empty where it may have flown.
std::string never_flew(const FlightLog& log, const Vehicle& vehicle);

}  // namespace ident
