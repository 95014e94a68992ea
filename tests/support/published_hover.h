// The published vehicle in hover, as a log and as the record of it.
#pragma once

#include "ident/flight/make_record.h"
#include "ident/flight/record/flight_record.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/sim/simulate.h"

namespace ident::testing {

inline Vehicle published_vehicle() {
  return read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
}

/// `truth` hovers; `model` is what it is taken for, and outlives the record.
inline FlightRecord hover_record(const Vehicle& truth, const Vehicle& model, double seconds) {
  SimulationOptions options;
  options.scenario = "hover";
  options.duration = seconds;
  options.rate = 100.0;
  const std::vector<FlightLog> logs{simulate_flight(truth, options).log};
  return make_flight_record(model, parameter_vector(model), logs);
}

}  // namespace ident::testing
