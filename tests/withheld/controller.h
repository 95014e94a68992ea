// The autopilot of the simulated vehicle: cascaded position and attitude control that knows its motors.
#pragma once

#include "flight_plan.h"
#include "physics.h"
#include "vehicle.h"

namespace withheld {

class Controller {
 public:
  explicit Controller(const Vehicle& vehicle, double delay_margin = 0);

  // Normalised commands from what the autopilot believes; call once per control period.
  Four command(const Reference& reference, const Motion& believed, const Four& Omega, const Four& dOmega,
               double dt);

 private:
  Eigen::Vector3d wanted_acceleration(const Reference& reference, const Motion& believed, double dt);

  Vehicle v_;
  Eigen::Matrix4d allocation_, inverse_;  // rotor thrusts to (lift along -z, moments)
  double bandwidth_;                      // rad/s, of attitude
  Eigen::Vector3d position_sum_ = Eigen::Vector3d::Zero(), attitude_sum_ = Eigen::Vector3d::Zero();
  double steepest_;  // tangent of the largest tilt
};

}  // namespace withheld
