// Flights of which nothing but commands and path was logged.
#pragma once

#include <vector>

#include "ident/core/random.h"
#include "support/published_hover.h"

namespace ident::testing {

/// The constants of the published vehicle on four upright rotors.
inline Vehicle upright() {
  Vehicle vehicle = published_vehicle();
  vehicle.parameters.erase("alpha");
  vehicle.layout = "x";
  vehicle.rotors = layout_rotors("x", 0.17, 0.0);
  return vehicle;
}

struct PathOnly {
  double seconds = 20.0;
  std::string scenario = "hover", noise = "typical";
  bool velocity = true, battery = false;
};

inline FlightLog path_only(const Vehicle& vehicle, std::uint64_t seed, const PathOnly& how = {}) {
  SimulationOptions options;
  options.scenario = how.scenario;
  options.noise = noise_level(how.noise);
  options.duration = how.seconds;
  options.rate = 50.0;
  options.seed = seed;
  options.signals.rates = options.signals.force = options.signals.attitude = options.signals.rotor_speeds = 0;
  if (!how.battery) options.signals.battery = 0;
  if (!how.velocity) options.signals.velocity = 0;
  return simulate_flight(vehicle, options).log;
}

/// The vehicle with those thrusts of its rotors, relative to what is stated.
inline Vehicle with_ratios(Vehicle vehicle, const std::vector<double>& ratios,
                           std::optional<double> std = {}) {
  for (std::size_t k = 0; k < ratios.size(); ++k)
    vehicle.parameters["rotor_mismatch.ratio@" + std::to_string(k + 1)] = {ratios[k], std};
  return vehicle;
}

}  // namespace ident::testing
