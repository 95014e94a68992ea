// Refinement of random vehicles with known truth: what was flown, what came out, and the bound of the same
// problem.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/flight/kernel/noise_model.h"
#include "ident/model/vehicle.h"
#include "ident/sim/simulate.h"

namespace ident::flight_campaign {

/// A vehicle as it is, as its bench measured it, and its logs.
struct Case {
  std::uint64_t seed = 0;
  Vehicle truth, stated;
  bool rotor_speeds = true;
  double gusts = 0.0;             ///< standard deviation, m/s
  ColouredNoise drift{0.0, 6.0};  ///< of the attitude shown, rad
  bool filter = false;
  double shaken = 0.0;  ///< amplitude of each rotor's tone, in units of the accelerometer's noise
  bool by_gyro = false;
  bool silent = false;  ///< neither a dead time nor Jp is stated
  bool one_by_one = false;
  std::vector<SimulatedFlight> flights;
  std::vector<std::string> scenarios;
  /// Standard deviation of what the air does over that of what the rotors do, both without gravity:
  /// accelerations, angular accelerations.
  double push_share = 0.0, turn_share = 0.0;

  std::vector<FlightLog> logs() const;
};

struct CaseOptions {
  double seconds = 40.0;  ///< of each of two logs
  bool turbulence = false;
  bool commands = true;  ///< without, measured rotor speeds are the input
  double drift = 0.0;    ///< standard deviation of a slow error of the attitude shown, rad
  bool filter = false;   ///< attitude, velocity and position as a complementary filter shows them
  bool silent = false;   ///< nobody states Jp, nor a dead time, which half of the vehicles have
  bool by_gyro = false;  ///< the controller flies by the rates that the log shows, as an autopilot does
  double shaken = 0.0;   ///< amplitude of a rotor's tone in the IMU, in units of the accelerometer's noise
  bool many_rotors = false;  ///< six or eight, half of the vehicles without rotor speeds
  bool one_by_one = false;   ///< the logs one after the other, what the first tells stored in between
};

/// Layouts 4sp, plus and x; a quarter without rotor speeds; each constant but the mass (0.2 %) known to 5 to
/// 20 %. Gusts are such that they make 7 to 70 % of the acceleration that the rotors command (log-uniform).
Case random_case(std::uint64_t seed, const CaseOptions& options);

/// One constant of one vehicle.
struct Estimate {
  std::string name;
  double truth = 0.0, value = 0.0, std = 0.0, naive_std = 0.0, prior_std = 0.0;
  double bound = 0.0;  ///< root of the inverse information at the truth, with the true noise and the priors
  bool inside = false, inside_naive = false;  ///< the 95 % intervals hold the truth
  bool identifiable = false;
};

struct Outcome {
  std::uint64_t seed = 0;
  bool rotor_speeds = true;
  double push_share = 0.0, turn_share = 0.0, seconds = 0.0;
  std::string failure;  ///< why there are no estimates
  std::vector<Estimate> estimates;
};

/// Refines as `ident flightlog --refine` does and compares.
Outcome refine_case(const Case& flown);

/// Standard deviations of the constants that are free, by name order of the refinement.
std::vector<std::pair<std::string, double>> bounds(const Case& flown);

/// One line of JSON, and back.
std::string as_line(const Outcome& outcome);
Outcome from_line(const std::string& line);

}  // namespace ident::flight_campaign
