// Simulated flights of which some streams are late, and what is made of them.
#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <vector>

#include "ident/flight/conditioning/align_streams.h"
#include "ident/flight/make_record.h"
#include "ident/flight/prepare.h"
#include "ident/sim/simulate.h"

namespace ident::testing {

inline constexpr double kRate = 200;

inline FlightLog simulated(const Vehicle& vehicle, const std::string& scenario, std::uint64_t seed) {
  SimulationOptions options;
  options.scenario = scenario, options.duration = 25, options.seed = seed;
  options.rate = kRate, options.longest_step = 0;
  return simulate_flight(vehicle, options).log;
}

inline FlightRecord record_of(const Vehicle& vehicle, const std::vector<FlightLog>& logs) {
  std::vector<Warning> assumed;
  return make_flight_record(vehicle, starting_constants(vehicle, logs, assumed), logs);
}

/// The log with one of its streams `rows` late.
inline void delay(std::vector<double>& column, std::size_t rows) {
  for (std::size_t i = column.size(); i-- > 0;) column[i] = i >= rows ? column[i - rows] : kNaN;
}

struct Aligned {
  std::vector<FlightLog> logs;
  std::vector<Warning> warnings;
};

inline Aligned aligned(const Vehicle& vehicle, const FlightLog& log) {
  const std::vector<FlightLog> logs{log};
  Aligned out;
  out.logs = aligned_streams(record_of(vehicle, logs), logs, vehicle.g, out.warnings).logs;
  return out;
}

/// A flight in which these streams are `rows` late.
inline FlightLog late_by(std::size_t rows, const Vehicle& vehicle,
                         std::initializer_list<std::array<std::vector<double>, 3> FlightLog::*> streams) {
  FlightLog log = simulated(vehicle, "mixed", 5);
  for (const auto stream : streams)
    for (auto& column : log.*stream) delay(column, rows);
  return log;
}

}  // namespace ident::testing
