// What a flight log can tell, by the signals that it has and their rates, and the one setting to change.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/data/log_streams.h"

namespace ident {

/// Rates of what was sampled, Hz; 0: not there.
struct SignalRates {
  double commands = 0, speeds = 0, rates = 0, specific_force = 0, attitude = 0, velocity = 0, position = 0,
         battery = 0;
};
SignalRates signal_rates(const FlightLog& flight);

/// How much the flight moved the vehicle, within its windows.
struct Motion {
  std::array<double, 3> rates{};  ///< standard deviation, rad/s
  double thrust = 0;              ///< spread of the specific force along z over its mean
  double fastest = 0;             ///< m/s
};
Motion motion_of(const FlightLog& flight);

struct LogAdvice {
  std::vector<std::string> can, cannot;
  std::string setting;   ///< to change before the next flight; empty: none
  std::string movement;  ///< whether the flight moved enough
};
LogAdvice advise(const LogStreams& log, const SignalRates& rates, const Motion& motion);

}  // namespace ident
