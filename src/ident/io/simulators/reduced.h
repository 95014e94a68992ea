// A vehicle as a simulator's file can hold it: effects folded into the constants they change, the rest left
// out.
#pragma once

#include <string>
#include <vector>

#include "ident/io/simulators/capacity.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Damping that stands for a motor of first order: the second pole is 4 million times as fast as the first.
inline constexpr double kFirstOrderDamping = 1000.0;
/// Whether the damping of a vehicle stands for that.
inline bool is_first_order(const Vehicle& vehicle) {
  return vehicle.value("zeta_m") >= kFirstOrderDamping / 20;
}

/// Time constants of a rotor's speed, s: 2 zeta_m/omega_m has the mean delay of the second-order motor.
struct MotorLags {
  double up = 0.0, down = 0.0, dead_time = 0.0;
};
MotorLags motor_lags(const Vehicle& vehicle);

/// States a motor of first order; `down` other than `up` becomes motor_asymmetry.ratio. 0: follows at once.
void set_first_order(Vehicle& vehicle, double up, double down);

/// Mass, inertia, centre of gravity and rotor momentum with what every effect adds to them.
struct MassProperties {
  double m = 0.0, Jp = 0.0;
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  Eigen::Vector3d c_B = Eigen::Vector3d::Zero();
};
MassProperties mass_properties(const Vehicle& vehicle);
void set_mass_properties(Vehicle& vehicle, const MassProperties& body);

/// Factor of a rotor's kT and kQ on those of the vehicle (rotor 0 is the first).
double rotor_ratio(const Vehicle& vehicle, std::size_t rotor);

/// Steady rotor speed at hover with equal upright rotors, rad/s.
double hover_speed(const Vehicle& vehicle);
/// Rotor speed at full command, rad/s.
double full_speed(const Vehicle& vehicle);

/// The vehicle that a file with this capacity describes. Throws UsageError where the layout does not fit, or
/// where the vehicle lacks what every simulator needs.
Vehicle reduced(const Vehicle& vehicle, const Capacity& holds, std::string_view target);

}  // namespace ident
