// At which commands and rotor speeds a vehicle carried its weight in a log.
#pragma once

#include <optional>

#include "ident/data/flight_log.h"
#include "ident/data/log_streams.h"
#include "ident/model/vehicle.h"

namespace ident {

struct CarriedWeight {
  std::optional<double> command;  ///< 0 to 1
  std::optional<double> speed;    ///< rad/s
};

/// Root mean square over the rotors, median over the time in the air, taken to a thrust of one weight by the
/// accelerometer where there is one. Thrust is taken as quadratic. Empty where the log does not say.
CarriedWeight carried_weight(const FlightLog& log, double g);

/// The same of a log as its format has it; empty where it holds no flight.
CarriedWeight carried_weight(const LogStreams& log, const Vehicle& vehicle);

}  // namespace ident
