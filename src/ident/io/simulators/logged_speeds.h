// Files that state thrust and no rotor speed are read with an assumed one; logs tell the true one.
#pragma once

#include <span>
#include <string>

#include "ident/data/flight_log.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Whether the file at `path` is one of a simulator that knows no rotor speed.
bool assumes_rotor_speeds(const std::string& path);

/// The vehicle of such a file with the rotor speeds of these logs: by the commands beside them, or else by
/// the weight that they carry. kT km^2, kQ km^2, Jp km and Omega_0/km stay what they are: steady flight is
/// the same. As it was where no speed was measured.
Vehicle with_logged_speeds(Vehicle vehicle, std::span<const FlightLog> logs);

}  // namespace ident
