// One flight: vehicle, air, controller and sensors stepped together.
#pragma once

#include <optional>

#include "ledger.h"
#include "plan.h"

namespace field {

struct FlightSettings {
  AirLevel air;
  double gust_share = 1;  // of the stated level
  double duration = 40;   // s in the log
  double charge = 0.9;    // of the battery at the start
  int style = 0;
  FlightLimits limits;
};

struct Flight {
  std::vector<Row> rows;
  std::optional<Ledger> ledger;
  std::vector<std::string> manoeuvres;
  // What happened, to judge whether the flight is a sane one.
  double greatest_rate = 0, greatest_tilt = 0, greatest_speed = 0;  // rad/s, rad, m/s
  double lowest = 0;                                                // m above ground
  double saturated = 0;                                             // share of mixer updates at a limit
  double mean_thrust = 0;                                           // of the weight, along world z
  double voltage_first = 0, voltage_last = 0;
  double command_least = 1, command_most = 0, rms_position_error = 0;
};

// `random` is the stream of this flight. Shares of causes are recorded where `stated` is given.
Flight fly(const Vehicle& v, const Effects& e, const Tuning& tuning, const Instruments& instruments,
           const FlightSettings& settings, const Stated* stated, Random random);

}  // namespace field
