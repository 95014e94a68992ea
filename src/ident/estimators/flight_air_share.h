// How much of what turns a vehicle is the air.
#pragma once

#include <array>

#include "ident/estimators/flight_fit.h"

namespace ident {

/// About roll, pitch and yaw.
struct AirShare {
  /// Angular accelerations from outside by those of the rotors: root mean squares over the states of a fit.
  std::array<double, 3> over_rotors{};
  std::array<double, 3>
      seconds{};  ///< for which what comes from outside lasts, in the log where it is quickest
};
/// Zeros without process noise.
AirShare air_share(const FlightRecord& record, const FlightFit& fit);

/// Warns (`air_turns`) of axes about which gusts do half of what the rotors do and more, and are as quick as
/// a controller that answers them. What it does and what the air does are not told apart then: the moments of
/// inertia about these axes, the motors where it is roll or pitch, and what rotors do about yaw do not count
/// as known.
void warn_of_air(Result& result, const AirShare& air);

}  // namespace ident
