// Constants that a vehicle file need not state: which of them a flight can show, and the warnings when one is
// found.
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

/// Whether the vehicle states a constant or an effect that is the same, or the constant is free.
bool is_there(const std::string& name, const std::vector<FreeConstant>& constants, const Vehicle& vehicle);

/// Whether logs with these signals can show the constant: what concerns the motors only with commands.
bool can_show(const std::string& name, const Signals& signals);

/// Whether Jp has to be free from the start. Without a prior Jzz would take its place, and what is left of
/// the effect of the one on the other would count as gusts.
bool asks_at_once(const std::vector<FreeConstant>& constants, const Vehicle& vehicle,
                  const FlightRecord& record);

/// Adds the constants `names`, held and watched, so that their scores come with the fit. Not those that the
/// vehicle states, that are free, or that are there as an effect.
void watch(const std::vector<std::string>& names, std::vector<FreeConstant>& constants,
           const Vehicle& vehicle, const FlightRecord& record, const std::vector<double>& p);

/// `command_offset`, `dead_time`, `rotor_inertia`.
void warn_of_found(const std::vector<std::string>& found, Result& result);

}  // namespace ident
