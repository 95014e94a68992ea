// What is known of a vehicle before anything is estimated: geometry, and constants with their uncertainty.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ident/model/air_level.h"
#include "ident/result/correlation.h"
#include "ident/result/finding.h"

namespace ident {

/// A rotor as mounted, body frame FRD. An upright rotor has axis (0,0,-1). With `slant_B` not zero the axis
/// follows the slant angle: axis = sin(alpha) slant_B + cos(alpha) (0,0,-1).
struct Rotor {
  Eigen::Vector3d r_B = Eigen::Vector3d::Zero();    ///< hub, m from the origin
  Eigen::Vector3d a_B = -Eigen::Vector3d::UnitZ();  ///< unit thrust axis
  int s = 1;                                        ///< spin, +1 counter-clockwise seen from above
  Eigen::Vector3d slant_B = Eigen::Vector3d::Zero();
};

/// Pulse widths that mean command 0 and 1.
struct CommandRange {
  double min_us = 1100.0, max_us = 1940.0;  ///< [Phang 23], microseconds (printed there as ms)
};

/// Signs of the reaction and gyroscopic torque: first principles, or as printed in [Phang 16, 18, 19].
enum class Signs { first_principles, as_published };

/// A constant with the standard deviation with which it is known; without one it is a plain statement.
struct Known {
  double value = 0.0;
  std::optional<double> std;
};

/// One schema for vehicle and parameter files. `parameters` also holds `m` (the file's `mass`) and every
/// `effect.parameter`; names are those of the file format.
struct Vehicle {
  std::string name, file;
  double g = 9.81;
  std::vector<Rotor> rotors;
  std::string layout;         ///< plus, x, 4sp, or empty when the rotors were given one by one
  std::optional<double> arm;  ///< m, centre to hub
  std::optional<CommandRange> command;
  std::optional<double> propeller_radius;  ///< m
  std::optional<double> air_density;       ///< kg/m^3
  double ground_z = 0.0;                   ///< NED z of the ground, m
  std::optional<double> battery_voltage;   ///< V at which km holds (battery_sag's v0)
  std::optional<AirLevel> air;             ///< how much it moves, where the file states it
  Signs signs = Signs::first_principles;
  std::map<std::string, Known> parameters;
  Correlation correlation;        ///< of what is known of those with a standard deviation
  std::vector<Warning> warnings;  ///< what was noticed in the file

  bool has(const std::string& parameter) const { return parameters.count(parameter) > 0; }
  /// Value of a parameter that the vehicle states, else its default.
  double value(const std::string& parameter) const;
};

/// The named layouts: `plus`, `x`, `4sp`, arm in m (centre to hub), slant in rad (4sp only).
/// Rotor order and spins as in notebooks/guide/formats.md. Throws UsageError on another name.
std::vector<Rotor> layout_rotors(const std::string& layout, double arm, double slant);

/// The vehicle's slant angle: parameter `alpha`, 0 without one.
inline double slant_angle(const Vehicle& vehicle) {
  return vehicle.has("alpha") ? vehicle.value("alpha") : 0.0;
}

/// Thrust axis of a rotor at a slant angle, rad.
inline Eigen::Vector3d axis_at(const Rotor& rotor, double alpha) {
  if (rotor.slant_B.isZero()) return rotor.a_B;
  return std::sin(alpha) * rotor.slant_B - std::cos(alpha) * Eigen::Vector3d::UnitZ();
}

}  // namespace ident
