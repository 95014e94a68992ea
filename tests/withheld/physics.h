// The true forces and moments: rotors in their local flow, body, rotor momentum, masses out of place.
#pragma once

#include <Eigen/Dense>

#include "effects.h"
#include "vehicle.h"

namespace withheld {

struct Motion {
  Eigen::Vector3d p, v;  // m, m/s, of the origin, world frame NED
  Eigen::Quaterniond q;  // body to world
  Eigen::Vector3d w;     // rad/s, body frame
};

struct Air {
  Eigen::Vector3d gust = Eigen::Vector3d::Zero();  // m/s, world frame, without the mean wind
  double vortex_noise = 0;                         // of size 1
};

struct Wrench {
  Eigen::Vector3d F = Eigen::Vector3d::Zero();  // N, without gravity, body frame
  Eigen::Vector3d M = Eigen::Vector3d::Zero();  // N m about the origin
};

struct Acceleration {
  Eigen::Vector3d f;   // m/s^2, specific force at the origin, body frame
  Eigen::Vector3d dw;  // rad/s^2
};

// Mass properties with all that hangs on the vehicle; computed once per flight.
struct Body {
  Body(const Vehicle& vehicle, const Effects& effects);
  double m;
  Eigen::Vector3d c;  // m, centre of gravity from the origin
  Eigen::Matrix3d J, J_inverse;
};

// Thrust transmitted to the airframe may differ from the one made (flexible arms): `thrust` returns the
// latter.
Wrench rotor_wrench(const Vehicle& vehicle, const Effects& effects, const Motion& motion, const Air& air,
                    const Four& Omega, const Four& dOmega, Four* thrust = nullptr,
                    const Four* transmitted = nullptr);

Wrench body_wrench(const Vehicle& vehicle, const Effects& effects, const Motion& motion, const Air& air);

Acceleration accelerate(const Body& body, const Wrench& wrench, const Eigen::Vector3d& w);

}  // namespace withheld
