// The equations of motion of MODEL.md, first-principles signs, and one step of Runge-Kutta.
#pragma once

#include <Eigen/Geometry>

#include "vehicle.h"

namespace written {

struct State {
  Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero(), w_B = Vector3d::Zero();
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  PerRotor Omega{}, dOmega{};  // rad/s, rad/s^2
  bool on_ground = true;
};

// m/s^2, FRD: (0, 0, -g) at rest.
Vector3d specific_force(const Vehicle& v, const State& x);

// The state one step later under a constant command. The ground is at z = 0; a vehicle on it stands level and
// still.
State advance(const Vehicle& v, const State& x, const PerRotor& delta);

}  // namespace written
