// Makes a record of flight logs: arcs in flight, conditioned, with noise levels and states to start from.
#pragma once

#include <span>

#include "ident/flight/record/flight_record.h"

namespace ident {

struct RecordOptions {
  double longest_gap = 0.25;  ///< s without a row that ends an arc
};

/// Splits logs into arcs in flight. `p` are the constants to start from (motor states are simulated with
/// them). Throws DataError when nothing is left to estimate from.
FlightRecord make_flight_record(const Vehicle& vehicle, std::span<const double> p,
                                std::span<const FlightLog> logs, const RecordOptions& options = {});

}  // namespace ident
