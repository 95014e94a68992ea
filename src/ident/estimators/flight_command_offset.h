// Whether rotor speed is proportional to the command: brushed motors and many speed controllers have an
// offset.
#pragma once

#include "ident/estimators/flight_fit.h"

namespace ident {

/// Adds Omega_0 to the constants of a fit, held at zero and watched: what the flight says against that comes
/// with the fit. Not where the vehicle states Omega_0 or it is free.
void watch_command_offset(std::vector<FreeConstant>& constants, const Vehicle& vehicle,
                          const FlightRecord& record, const std::vector<double>& p);

/// Whether it is watched in this fit.
bool watches_command_offset(const Theta& theta);

/// Whether the logs contradict a speed proportional to the command beyond any doubt: one Newton step from the
/// fit with the watched Omega_0 free, against its spread over blocks of time.
bool shows_command_offset(const Theta& theta, const FlightFit& fit);

}  // namespace ident
