// Whether rotor speed is proportional to the command: brushed motors and many speed controllers have an
// offset.
#pragma once

#include "ident/estimators/flight_fit.h"

namespace ident {

/// Whether the logs contradict a speed proportional to the command beyond any doubt: one Newton step from the
/// fit with Omega_0 free, against its spread over blocks of time. False where the vehicle states Omega_0.
bool needs_command_offset(const Vehicle& vehicle, const FlightRecord& record, const Theta& theta,
                          const FlightFit& fit);

}  // namespace ident
