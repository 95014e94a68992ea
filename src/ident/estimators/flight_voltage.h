// The voltage of the logs of one flight after another.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "ident/data/flight_log.h"

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

}  // namespace ident
