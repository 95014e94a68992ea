// The voltage of the logs of one flight after another.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "ident/data/flight_log.h"
#include "ident/model/vehicle.h"

namespace ident {

/// The highest of all logs, V: what sag is counted from where the vehicle file names no voltage, one for all
/// logs, which share km. Far below zero where none was logged.
inline double highest_voltage(std::span<const FlightLog> logs) {
  double highest = -1e300;
  for (const FlightLog& log : logs)
    for (const double v : log.vbat)
      if (std::isfinite(v)) highest = std::max(highest, v);
  return highest;
}

/// `battery_not_modelled`: by how much the voltage of the logs varies where the vehicle file states no
/// battery_sag, so that commands count as if it did not; none where that is little.
std::optional<Warning> battery_not_modelled(const Vehicle& vehicle, std::span<const FlightLog> logs);

}  // namespace ident
