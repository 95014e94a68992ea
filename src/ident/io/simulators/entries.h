// What several formats need to make a vehicle of their entries.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "ident/io/simulators/fields.h"
#include "ident/io/simulators/reduced.h"
#include "ident/io/simulators/value.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Rotor speed at full command, rad/s, where a file speaks of thrust only. Nothing but the scale of kT, kQ
/// and km depends on it.
inline constexpr double kAssumedFullSpeed = 1000.0;

/// Forward, left, up to forward, right, down and back.
inline Eigen::Vector3d flipped(const Eigen::Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }
/// The same of an inertia matrix.
inline Eigen::Matrix3d flipped(const Eigen::Matrix3d& J) {
  const Eigen::DiagonalMatrix<double, 3> turn(1.0, -1.0, -1.0);
  return turn * J * turn;
}

inline void assume(Vehicle& vehicle, const Fields& fields, const std::string& what) {
  vehicle.warnings.push_back({"assumed", fields.file() + ": " + what});
}

/// States a constant unless it is zero, where zero means that it is absent.
inline void state_unless_zero(Vehicle& vehicle, const std::string& name, double value) {
  if (value != 0.0) vehicle.parameters[name] = {value, {}};
}

inline double value_or_zero(const Vehicle& vehicle, const std::string& name) {
  return vehicle.has(name) ? vehicle.value(name) : 0.0;
}

/// Thrust, N, of a rotor at full command.
inline double full_thrust(const Vehicle& v) { return v.value("kT") * full_speed(v) * full_speed(v); }
inline double torque_per_thrust(const Vehicle& v) { return v.value("kQ") / v.value("kT"); }

/// kT, kQ and km from the thrust and torque at full command, with the assumed speed.
inline void set_by_full_thrust(Vehicle& v, double thrust, double torque) {
  v.parameters["kT"] = {as_stated(thrust / (kAssumedFullSpeed * kAssumedFullSpeed)), {}};
  v.parameters["kQ"] = {as_stated(torque / (kAssumedFullSpeed * kAssumedFullSpeed)), {}};
  v.parameters["km"] = {kAssumedFullSpeed, {}};
}

/// Linear drag, N s/m, that the rotors and the airframe of a vehicle have on the whole, for files that hold
/// no other. Rotors at hover speed; the airframe by its secant at `speed` m/s.
inline double whole_linear_drag(const Vehicle& v, double speed) {
  const double world = (value_or_zero(v, "Kdx") + value_or_zero(v, "Kdy") + value_or_zero(v, "Kdz")) / 3.0;
  return world + static_cast<double>(v.rotors.size()) * value_or_zero(v, "rotor_drag.kd") * hover_speed(v) +
         value_or_zero(v, "parasitic_drag.C") * speed;
}

}  // namespace ident
