// Flights of the published vehicle and what a diagnosis says of them.
#pragma once

#include <initializer_list>

#include "ident/gap/diagnose.h"
#include "support/published_hover.h"

namespace ident::testing {

inline FlightLog flight_of(const Vehicle& vehicle, std::uint64_t seed) {
  SimulationOptions options;
  options.duration = 25.0;
  options.rate = 100.0;
  options.seed = seed;
  return simulate_flight(vehicle, options).log;
}

/// Bench values to that share of themselves.
inline void known_to(double share, std::initializer_list<const char*> names, Vehicle& model) {
  for (const char* name : names) model.parameters.at(name).std = share * model.value(name);
}

inline nlohmann::ordered_json verdict_of(const Vehicle& model, const FlightLog& log) {
  const std::vector<FlightLog> logs{log};
  return diagnose_gap(model, logs).result.extra["verdict"];
}

}  // namespace ident::testing
