// Constants that a vehicle file need not state: which a flight can show, and what is said when one is found.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

inline const std::string kOffset = "Omega_0", kDeadTime = "dead_time", kRotor = "Jp";

inline bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// Whether the vehicle states a constant, or an effect that is the same, or it is free.
bool is_there(const std::string& name, const std::vector<FreeConstant>& constants, const Vehicle& vehicle);

/// Of how motors follow their commands nothing is told without these.
bool can_show(const std::string& name, const Signals& signals);

/// Where nothing is known of the inertia about yaw, it takes the place of that of the rotors, and what the
/// one leaves of the other's work passes for gusts: then both are free from the start.
bool asks_at_once(const std::vector<FreeConstant>& constants, const Vehicle& vehicle,
                  const FlightRecord& record);

/// Adds those of `names` to the constants, held where they are and watched: what the flight says against that
/// comes with the fit. Not one that the vehicle states or that is free, nor one that is there as an effect.
void watch(const std::vector<std::string>& names, std::vector<FreeConstant>& constants,
           const Vehicle& vehicle, const FlightRecord& record, const std::vector<double>& p);

/// `command_offset`, `dead_time`, `rotor_inertia`.
void warn_of_found(const std::vector<std::string>& found, Result& result);

}  // namespace ident
