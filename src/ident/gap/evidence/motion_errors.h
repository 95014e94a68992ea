// Errors of prediction of held-out flight in m/s, rad/s and degrees, by the model as stated and by the one
// found.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "ident/flight/record/flight_record.h"

namespace ident {

/// Two models of a vehicle, and what the fit found of the sensors.
struct ComparedModels {
  std::vector<double> stated, found;             ///< constants
  std::vector<std::array<double, 3>> gyro_bias;  ///< by log, rad/s
  std::array<double, kChannels> sigma{};         ///< white noise of the channels
};

/// `forces` (m/s: velocity with attitude and rates as measured), `moments` (rad/s: rates with velocity as
/// measured) and `open_loop` (deg: attitude with everything predicted), each from measured states over 0.1,
/// 0.5 and 1 s, root mean square: before, after, noise_floor, closed. Null where the logs do not hold what
/// it takes.
nlohmann::ordered_json motion_errors(FlightRecord held_out, const ComparedModels& models);

}  // namespace ident
