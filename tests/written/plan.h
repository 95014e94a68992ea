// What the pilot wants: take-off, hover, steps of roll, pitch and yaw, climbs, forward flight, landing.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace written {

using Eigen::Vector3d;

struct Wish {
  Vector3d v_W = Vector3d::Zero();  // m/s
  double height = 0;                // m above ground, held where `hold_height`
  bool hold_height = true;
  double roll = 0, pitch = 0;        // rad, on top of what the velocity loop wants
  double yaw_rate = 0;               // rad/s
  Vector3d rate = Vector3d::Zero();  // rad/s, on top of what the attitude loop wants
};

// Phases of a flight, s.
constexpr double kArm = 1.5, kTakeOff = 3.0, kHover = 7.0, kManoeuvres = 10.0, kDescend = 51.0, kEnd = 60.0;

class Plan {
 public:
  Plan(std::uint64_t seed, double vigour);  // vigour: 1 for 1 kg; smaller vehicles turn faster
  Wish at(double t) const;

 private:
  double vigour_;
  std::vector<Vector3d> chips_;  // signs of a random binary sequence per axis
};

}  // namespace written
