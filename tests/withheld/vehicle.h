// The true vehicle of a withheld case, and how one is drawn at random.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <string>
#include <vector>

#include "random.h"

namespace withheld {

constexpr int kRotors = 4;
using Four = Eigen::Vector4d;

struct Rotor {
  Eigen::Vector3d r;  // m, hub from the file's origin, body frame
  Eigen::Vector3d a;  // thrust axis
  double s;           // +1 counter-clockwise seen from above
};

struct Vehicle {
  std::string layout;          // plus, x or 4sp
  bool short_form = false;     // the file states layout and arm instead of rotors
  double gravity = 9.81;       // m/s^2
  double air_density = 1.225;  // kg/m^3
  double m = 0, arm = 0;       // kg, m
  double radius = 0;           // m, propeller
  double slant = 0;            // rad, 4sp only
  double hub_height = 0;       // m above the origin
  double kT = 0, kQ = 0;       // N s^2, N m s^2
  double km = 0, omega_m = 0, zeta_m = 0;
  Eigen::Vector3d J = Eigen::Vector3d::Zero();  // kg m^2, principal
  std::array<Rotor, kRotors> rotors;
  int pulse_min = 1100, pulse_max = 1940;  // us
  int cells = 1;                           // of the battery
  double endurance = 600;                  // s of hover from a full pack

  double hover_speed() const;    // rad/s, all rotors alike
  double induced_speed() const;  // m/s, of momentum theory at hover
  double hover_command() const { return hover_speed() / km; }
};

Vehicle draw_vehicle(Random& random);

// rad/s, of the attitude loop that its motors allow.
double attitude_bandwidth(const Vehicle& vehicle);

// The base parameters by name, in the order in which they are listed in files.
const std::vector<std::string>& base_parameter_names();
double& base_parameter(Vehicle& vehicle, const std::string& name);
double base_parameter(const Vehicle& vehicle, const std::string& name);

}  // namespace withheld
