// The true constants of a quadrotor, in the motor order of its autopilot.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>

namespace written {

using Eigen::Vector3d;
using PerRotor = std::array<double, 4>;

constexpr double kGravity = 9.81;     // m/s^2
constexpr double kStep = 1.0 / 4000;  // s, of the simulation

enum class Stack { px4, ardupilot, betaflight, crazyflie };

struct Rotor {
  Vector3d r_B;  // m, FRD
  double s;      // +1: turns counter-clockwise seen from above
};

struct Vehicle {
  std::string name;
  Stack stack;
  double m;                    // kg
  Vector3d J;                  // kg m^2, principal
  double kT, kQ;               // N s^2/rad^2, N m s^2/rad^2
  double km, omega_m, zeta_m;  // rad/s per unit command, rad/s, -
  double Jp;                   // kg m^2
  std::array<Rotor, 4> rotors;
  int control_steps;         // simulation steps for one run of the rate controller
  double gyro_hz, accel_hz;  // cut-offs of the autopilot's own filters
  bool accel_biquad = true;  // else two first-order stages (Betaflight since 4.5)
  double thrust_model = 0;   // PX4's THR_MDL_FAC
};

// A vehicle of this stack, its constants within 5 % of a typical one.
Vehicle make_vehicle(Stack stack, const std::string& name, std::uint64_t seed);

}  // namespace written
