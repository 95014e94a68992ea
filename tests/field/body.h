// Rigid body with turning rotors about its true centre of gravity.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "air.h"
#include "rotor.h"

namespace field {

struct Motion {  // of the centre of gravity
  Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero(), w_B = Vector3d::Zero();
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
};

struct Acceleration {
  Vector3d f_B = Vector3d::Zero();   // m/s^2, specific force of the centre of gravity
  Vector3d dw_B = Vector3d::Zero();  // rad/s^2
};

// What the rotors do just now.
struct RotorState {
  PerRotor Omega, dOmega;  // rad/s, rad/s^2
  PerRotor fluctuation;    // relative, of thrust
  PerRotor arm_force;      // N, thrust that arrives at the body less that of the rotor; zero for stiff arms
};

std::vector<RotorLoad> rotor_loads(const Vehicle& v, const Effects& e, const Motion& motion,
                                   const RotorState& rotors, const AirSample& air);

Eigen::Matrix3d inertia(const Vehicle& v, const Effects& e);

// Acceleration by loads, drag of the body, reaction and gyroscopic torque of the rotors.
Acceleration accelerate(const Vehicle& v, const Effects& e, const Motion& motion, const RotorState& rotors,
                        const AirSample& air);

// One step of length dt; f_B and dw_B as at its start, with omega x J omega taken at its middle.
Motion advance(const Vehicle& v, const Effects& e, const Motion& motion, const Acceleration& a, double dt);

}  // namespace field
