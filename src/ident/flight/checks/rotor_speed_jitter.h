// Rotor speeds that change from row to row by themselves, and a vehicle that feels it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// How much of what measured rotor speeds jitter by, beside the fit, the vehicle feels: 0 for noise of their
/// sensor, 1 for speeds that are as measured.
struct FeltJitter {
  double share = 0.0, std = 0.0;
  double size = 0.0;  ///< standard deviation of that jitter's thrust, of the weight
  /// Correlation of its second differences next to each other: -2/3 of what is white, -0.3 to -0.5 of jumps
  /// that motors follow within some rows. What a wrong model leaves is smoother.
  double neighbours = 0.0;

  /// Whether most of it is real, beyond doubt: then commands do not tell what the rotors do from row to row,
  /// and a fit that takes it for noise of the sensor makes the vehicle answer to less than there is.
  bool matters() const {
    return share > 0.5 && share < 1.5 && share > 8 * std && size > 3e-3 && neighbours < -0.25;
  }
  /// What was seen, and what comes of it.
  Warning warning(const std::string& consequence) const;
};

/// Nothing is felt where logs lack commands, rotor speeds or specific force.
FeltJitter felt_jitter(const FlightRecord& record, const Theta& theta, const FlightFit& fit);

/// Whether every log has rotor speeds, and nothing is asked (`free`) that only commands tell.
bool may_do_without_commands(std::span<const FlightLog> logs, std::span<const std::string> free);

/// The logs with measured speeds as their input.
std::vector<FlightLog> without_commands(std::span<const FlightLog> logs);

}  // namespace ident
