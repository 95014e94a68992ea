// A manoeuvre flown twice: by a simulator's own equations, and by ident's model of what its file holds.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "ident/model/vehicle.h"

namespace ident::test {

/// Rigid body in a simulator's frames: forward, left, up; the world's z is up. Motors: whatever they stand
/// for there.
struct SimulatorState {
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero(), w = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  ///< body to world
  std::vector<double> motors;
};

/// Force and moment of everything but gravity, in the body frame, about the centre of gravity; and the body
/// itself.
struct SimulatorWrench {
  Eigen::Vector3d F, M;
};
struct SimulatorEquations {
  double m = 0.0, g = 9.81;
  Eigen::Matrix3d J;
  /// `motors_dot` is the rate of change of the motors.
  std::function<SimulatorWrench(const SimulatorState&, const std::vector<double>& motors_dot)> wrench;
  std::function<double(double delta, std::size_t rotor)> target;  ///< of a motor for ident's command
  double tau_up = 0.0, tau_down = 0.0;                            ///< s, first order; 0: at once
};

/// Commands held for 2 ms each: hover, doublets in roll, pitch and yaw, a climb.
struct Manoeuvre {
  std::vector<std::vector<double>> delta;             ///< [row][rotor]
  Eigen::Vector3d v_start = Eigen::Vector3d::Zero();  ///< m/s, FRD
};
Manoeuvre hover_and_steps(const Vehicle& vehicle);
/// The same from 9 m/s forward, 2 m/s to the right and 1 m/s up.
Manoeuvre fast_forward(const Vehicle& vehicle);

/// Position, velocity, quaternion and rates after each row, in forward, right, down.
using Flown = std::vector<Eigen::Matrix<double, 13, 1>>;

Flown fly(const SimulatorEquations& equations, const Manoeuvre& manoeuvre);
Flown fly(const Vehicle& vehicle, const Manoeuvre& manoeuvre);

/// The largest difference of any component, m, m/s, rad/s.
double largest_difference(const Flown& a, const Flown& b);

}  // namespace ident::test
