// Thrust for the same commands over the voltage of the battery, read off the logs without the vehicle's
// motion: whatever else is wrong with a model, a sagging battery shows here.
#pragma once

#include "ident/flight/record/flight_record.h"

namespace ident {

/// The logarithm of specific force along the rotors per sum of squared steady rotor speeds, in stretches of
/// some seconds, against the logarithm of the voltage: one line of all logs.
struct LevelThrust {
  int stretches = 0;
  int logs = 0;          ///< in which the voltage moves
  int rising = 0;        ///< of them, those in which the force rises with the voltage
  double n = kNaN;       ///< steady rotor speeds go with voltage^n, as battery_sag has it
  double n_std = kNaN;   ///< from the scatter about the line
  double varies = kNaN;  ///< standard deviation of that logarithm over the stretches
  double left = kNaN;    ///< and about the line

  /// Whether nothing but the battery makes what is seen: much of it, nearly all told by the voltage, with an
  /// exponent that motors have, in every one of several logs.
  bool plain() const;
};

/// `p`: the constants as stated. Nothing is found where logs lack commands, voltage or specific force.
LevelThrust level_thrust(const FlightRecord& record, const std::vector<double>& p);

}  // namespace ident
