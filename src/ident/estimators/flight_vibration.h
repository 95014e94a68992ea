// What an inertial sensor feels of the turning rotors: tones at multiples of their turns, folded by the rate
// of the log into all of its band.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/estimators/flight_record.h"

namespace ident {

/// What was found of it; without rotors: nothing.
struct Vibration {
  std::vector<double> of_rotor;  ///< RMS amplitude at the usual speed, in units of the sensors' noise
  double rates = 0.0;            ///< RMS amplitude of an axis by all rotors, rad/s
  double force = 0.0;            ///< m/s^2
  double speeds = 1.0;  ///< of the rotors, where none were measured, over those simulated from the commands
  bool one_alone = false;  ///< one rotor explains it about as well as all of them

  bool found() const { return !of_rotor.empty(); }
  /// The rotor that shakes the vehicle plainly more than the others, or as if alone, from 1; 0: there is
  /// none.
  int stands_out() const;
  /// Which one does, and by how much, in words; empty: none.
  std::string what_stands_out() const;
};

/// The logs with rates and specific force freed of the tones of rotors, with a warning `vibration`; empty
/// where there are none. The amplitudes of a tone in short windows are Gaussian with a variance for each
/// rotor and axis that goes with the fourth power of the rotor's speed; variances are those that make the
/// data most likely. Tones that fold to where vehicles move stay.
std::vector<FlightLog> without_vibration(const FlightRecord& record, std::span<const FlightLog> logs,
                                         Vibration& vibration, std::vector<Warning>& warnings);

}  // namespace ident
