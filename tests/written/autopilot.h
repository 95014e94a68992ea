// Cascaded loops from velocity to normalised torque and thrust; the mixer belongs to the firmware.
#pragma once

#include <Eigen/Geometry>

#include "mixer.h"
#include "plan.h"

namespace written {

struct Reading {
  Vector3d p_W, v_W, gyro;  // m, m/s, rad/s (filtered)
  Eigen::Quaterniond q_WB;
};

struct SetPoints {
  Vector3d rate = Vector3d::Zero();   // rad/s, FRD
  Vector3d euler = Vector3d::Zero();  // rad
  Inputs inputs = Inputs::Zero();     // what goes into the mixer
};

class Autopilot {
 public:
  explicit Autopilot(const Vehicle& v);
  SetPoints run(const Reading& reading, const Wish& wish, double dt);

 private:
  Vehicle v_;
  double hover_;            // normalised thrust that lifts the weight
  Eigen::Vector4d effect_;  // N m and N per unit of each input about hover
  double rate_gain_, attitude_gain_, velocity_gain_;
  double yaw_ = 0;
  Vector3d rate_integral_ = Vector3d::Zero();  // rad/s^2
  Vector3d velocity_integral_ = Vector3d::Zero();
};

}  // namespace written
