// What refinement, verification and diagnosis begin with: constants to start from, logs cut into arcs, and
// the test of their frames and signs.
#pragma once

#include <span>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/flight/conditioning/rotor_vibration.h"
#include "ident/flight/record/flight_record.h"
#include "ident/result/result.h"

namespace ident {

struct FlightEntry {
  std::vector<double> p;        ///< constants to start from
  FlightRecord record;          ///< refers to the vehicle of the call
  std::vector<Warning> tested;  ///< what the self-test of frames and signs found
  Vibration vibration;          ///< that was taken out of rates and specific force
};

/// Reads the logs into a record and tells `result` their names and warnings. Throws DataError when they hold
/// nothing to estimate from, UsageError without a mass.
FlightEntry enter_flight(const Vehicle& vehicle, std::span<const FlightLog> logs, Result& result);

/// Constants to start from where the vehicle file is silent, with what was assumed as warnings.
std::vector<double> starting_constants(const Vehicle& vehicle, std::span<const FlightLog> logs,
                                       std::vector<Warning>& warnings);

}  // namespace ident
