// What an inertial sensor feels of the turning rotors: tones at multiples of their turns, folded by the rate
// of the log into all of its band.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/flight/record/flight_record.h"
#include "ident/result/result.h"

namespace ident {

/// What was found of it; without rotors: nothing.
struct Vibration {
  /// RMS amplitude at the usual speed of an axis of that sensor which feels it most, in units of its noise.
  std::vector<double> of_rotor;
  double rates = 0.0;  ///< RMS amplitude of an axis by all rotors, rad/s
  double force = 0.0;  ///< m/s^2
  double speeds =
      1.0;  ///< of the rotors, where not all were measured, over those simulated from the commands
  bool one_alone = false;   ///< one rotor explains it about as well as all of them
  bool told_apart = false;  ///< and none of the others would
  bool passed_on = false;   ///< the controller answers to it
  double left_out = 0.0;    ///< share of the samples of a sensor that count as none

  bool found() const { return !of_rotor.empty(); }
  /// The rotor that shakes the vehicle plainly more than the others do, from 1; 0: there is none.
  int stands_out() const;
  /// Whether a propeller is out of balance, though perhaps not which.
  bool unbalanced() const { return one_alone || stands_out() > 0; }
  /// That in words; empty: none is.
  std::string what_is_unbalanced() const;
};

/// The logs with rates and specific force freed of the tones of rotors, with a warning `vibration`; empty
/// where there are none. The amplitudes of a tone in short windows are Gaussian with a variance for each
/// rotor and axis that goes with the fourth power of the rotor's speed; variances are those that make the
/// data most likely. Samples in which a tone that matters is folded to where vehicles move count as none.
std::vector<FlightLog> without_vibration(const FlightRecord& record, std::span<const FlightLog> logs,
                                         Vibration& vibration, std::vector<Warning>& warnings);

}  // namespace ident
