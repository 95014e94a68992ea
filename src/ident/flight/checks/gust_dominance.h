// How much of what turns a vehicle is the air.
#pragma once

#include <array>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// Squares of angular accelerations over time, of the air and of the rotors, which do the rest of a change.
class TurnedBy {
 public:
  /// A rate that changes by that (rad/s) in h seconds, while `outside` (rad/s^2) acts.
  void add(double h, const Vec3<double>& change, const Vec3<double>& outside) {
    air_ += h * outside.cwiseAbs2();
    rotors_ += h * (change / h - outside).cwiseAbs2();
  }
  /// Root mean squares, about x, y and z; 0 where rotors do nothing.
  std::array<double, 3> air_over_rotors() const;

 private:
  Vec3<double> air_ = Vec3<double>::Zero(), rotors_ = Vec3<double>::Zero();
};

/// About roll, pitch and yaw.
struct AirShare {
  /// Angular accelerations from outside by those of the rotors: root mean squares over the states of a fit.
  std::array<double, 3> over_rotors{};
  /// For which what comes from outside lasts, in the log where it is quickest.
  std::array<double, 3> seconds{};
};
/// Zeros without process noise.
AirShare air_share(const FlightRecord& record, const FlightFit& fit);

/// Warns (`air_turns`) of axes about which gusts do half of what the rotors do and more, and are as quick as
/// a controller that answers them. What it does and what the air does are not told apart then: the moments of
/// inertia about these axes, the motors where it is roll or pitch, and what rotors do about yaw do not count
/// as known.
void warn_of_air(Result& result, const AirShare& air);

}  // namespace ident
