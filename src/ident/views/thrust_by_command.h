// Thrust of a rotor over the commands that were flown: known where kT and km are known only together.
#pragma once

#include <span>

#include "ident/data/flight_log.h"
#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// Steady thrust at a command, N.
struct ThrustAt {
  double command, thrust, std;
};

/// From the 5th to the 95th percentile of the commands in flight, T = kT (Omega_0 + km delta)^2; empty where
/// no commands were logged. Effects that a vehicle states besides are not in it.
std::vector<ThrustAt> thrust_over_commands(const FlightRecord& record, std::span<const FlightLog> logs,
                                           const Theta& theta, const FlightFit& fit);

/// As `thrust_by_command` of a result's fit, and as a section with a picture; nothing without commands.
nlohmann::ordered_json as_json(const std::vector<ThrustAt>& curve);
Section thrust_section(const std::vector<ThrustAt>& curve);

}  // namespace ident
