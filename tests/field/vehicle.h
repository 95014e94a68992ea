// The true constants of a vehicle: frame, rotors, motors and battery, from a nano quadrotor to 2 kg.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "random.h"

namespace field {

using Eigen::Vector3d;
using PerRotor = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1>;  // at most eight rotors

inline constexpr double kGravity = 9.81;      // m/s^2
inline constexpr double kAirDensity = 1.225;  // kg/m^3

struct Hub {
  Vector3d r_B;  // m, from the file's origin
  double s;      // +1: counter-clockwise seen from above
};

struct Battery {
  int cells = 1;
  double capacity = 0;      // A s
  double R = 0;             // ohm, at once
  double R_slow = 0;        // ohm, over the time constant `slow`
  double slow = 10;         // s
  double reference = 0;     // V, at which km holds
  double base_current = 0;  // A, of the electronics
  double efficiency = 0.6;  // of motors and ESCs
};

struct Vehicle {
  std::string layout;  // "x", "plus" or "hex"
  std::vector<Hub> hubs;
  double m = 0, l = 0, radius = 0;  // kg, m, m (propeller)
  double kT = 0, kQ = 0, Jp = 0;    // N s^2/rad^2, N m s^2/rad^2, kg m^2
  double km = 0, Omega_0 = 0;       // rad/s: speed = km command + Omega_0 at the reference voltage
  double lag_up = 0, lag_down = 0;  // s, of a motor that speeds up, slows down
  double latency = 0;               // s, from the command to the motor
  Vector3d J = Vector3d::Zero();    // kg m^2
  Battery battery;

  int rotors() const { return static_cast<int>(hubs.size()); }
  double disc() const;          // m^2, of one rotor
  double hover_speed() const;   // rad/s
  double hover_inflow() const;  // m/s, induced speed v_h of T = 2 rho A v_h^2
  double lag() const { return 0.5 * (lag_up + lag_down); }
};

Vehicle draw_vehicle(Random& random);

}  // namespace field
