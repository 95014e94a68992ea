// Closed-loop flights of any vehicle file over named scenarios, seen by imperfect sensors.
//
//   SimulationOptions options;                       // mixed, 60 s, 250 Hz, typical noise
//   options.noise = noise_level("none");
//   options.longest_step = 0;                        // the same integrator as an estimator
//   const SimulatedFlight flight = simulate_flight(vehicle, options);
//   refine(flight.log); compare with flight.truth, row by row
//
// The vehicle's `effect.parameter` entries act. A row holds what the sensors show at t and the command that
// holds from t to the next row; the flight runs already before t = 0.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/model/flight.h"
#include "ident/model/vehicle.h"
#include "ident/sim/sensors.h"

namespace ident {

struct SimulationOptions {
  std::string scenario = "mixed";
  double duration = 60.0;      ///< s
  double rate = 250.0;         ///< rows, and commands, a second
  double longest_step = 5e-4;  ///< of the integrator, s; 0: an estimator's
  std::uint64_t seed = 1;
  SensorNoise noise = noise_level("typical");
  LoggedSignals signals;
  double turbulence = 0.0;  ///< gusts, standard deviation in m/s
  double gust_arm = 0.0;    ///< height above the origin at which they push, m
  bool by_gyro = false;     ///< the controller flies by the rates of the row, less their bias, if it has any
  double battery_used = 0.2;  ///< share of its voltage that the battery loses over the flight, if it has one
  std::function<void(double)> progress;  ///< told the share that is done
};

/// A log and what was behind it.
struct SimulatedFlight {
  FlightLog log;
  std::vector<FlightState<double>> truth;  ///< at each row
  Vec3<double> gyro_bias = Vec3<double>::Zero();
  double lowest = 0.0;    ///< least height of the origin above the ground, m
  double furthest = 0.0;  ///< greatest distance from where it should have been, m
};

/// Throws UsageError where the vehicle cannot fly, or an option makes no sense; DataError where it crashes.
SimulatedFlight simulate_flight(const Vehicle& vehicle, const SimulationOptions& options);

}  // namespace ident
