// What the four targets' equations have in common, as numbers: fast to fly, to tune on, and to fit.
//
// Forward, left, up. A motor is a rotor speed (Gazebo, RotorPy) or, where the target has none, the thrust
// over its constant (SIH, MuJoCo). The equations themselves are those of tests/io/simulators/equations;
// `largest_mismatch` compares.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <string>

#include "../withheld/effects.h"
#include "../withheld/vehicle.h"
#include "io/simulators/equations/by_thrust.h"

namespace mended {

using Eigen::Vector3d;
constexpr std::size_t kRotors = 4;
using Motors = std::array<double, kRotors>;

struct TargetRotor {
  Vector3d r = Vector3d::Zero();   // m, hub from the centre of gravity
  Vector3d a = Vector3d::UnitZ();  // thrust axis
  double kT = 0, kQ = 0;           // thrust and moment along the axis, per motor or per its square; kQ signed
};

struct TargetModel {
  std::string target;
  bool by_speed = true;  // thrust goes with the square of the motor
  double m = 1, g = 9.81;
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity(), J_inverse = Eigen::Matrix3d::Identity();
  Vector3d c = Vector3d::Zero();  // m, centre of gravity from the vehicle's origin
  std::array<TargetRotor, kRotors> rotors;
  double low = 0, full = 1;         // motor at command 0 and 1
  double tau_up = 0, tau_down = 0;  // s
  double kd = 0, kz = 0;            // kg/rad, across and along the axis
  double kh = 0;                    // kg/m, thrust by the speed across
  double k_flap = 0;                // N s^2/rad, moment k_flap w (v x a), as RotorPy has it
  double momentum = 0;              // kg m^2, rotor inertia as far as it counts
  Vector3d c_D = Vector3d::Zero();  // N s^2/m^2, of the airframe
  double linear_drag = 0;           // N s/m

  double motor_target(double delta) const;
  double command_for(double thrust, std::size_t rotor) const;
  void motors_after(const Motors& from, const Motors& delta, double h, Motors& out, Motors& rate) const;
  double hover_motor() const;
  // Drag in level flight at hover, N s/m at the speed.
  double drag_per_speed(double speed) const;
};

struct BodyWrench {
  Vector3d F, M;
};
BodyWrench wrench(const TargetModel& model, const Vector3d& v_body, const Vector3d& w, const Motors& motors,
                  const Motors& motors_dot);

// A simulator's file. Throws ident::InputError.
ident::Fields fields_of(const std::string& target, const std::string& text, const std::string& file);
TargetModel model_of(const std::string& target, const ident::Fields& fields);
ident::test::SimulatorEquations equations_of(const std::string& target, const ident::Fields& fields);

// The true vehicle as far as the target holds it, all its constants taken from the truth. `stated` is the
// user's model: gravity, and what stands for nothing real, come from there.
TargetModel reduced_truth(const std::string& target, const withheld::Vehicle& vehicle,
                          const withheld::Effects& effects, const TargetModel& stated);

// Largest difference of forces and moments at random states, relative to weight and to weight times arm.
double largest_mismatch(const TargetModel& model, const ident::test::SimulatorEquations& equations);

}  // namespace mended
