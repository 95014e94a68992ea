// The simulator's own cascaded controller: flies any vehicle with a bandwidth that follows its motors.
//
// Position and velocity errors ask for an acceleration, that for an attitude and a lift, these for angular
// accelerations, and those for rotor speeds by the pseudo-inverse of the effect of the rotors at hover. It
// knows the true state: what flies matters here, not how an estimator would help it.
//
//   chain of one axis: position, velocity, angle, rate, angular acceleration (motor of bandwidth w, damping
//   1) poles: (s + p1)^2 (s + p2)^2 (s + q)^2,  q = w - p1 - p2,  so that the motors are not asked for more
//
// Where dead time and sampling weigh more than the motor's lag, the motor is left alone and p2 is kept below
// 0.3 over the whole lag.
#pragma once

#include <span>
#include <vector>

#include "ident/model/trim.h"

namespace ident {

/// Where the vehicle should be.
struct Setpoint {
  Vec3<double> x_W, v_W, a_W;
  double psi = 0.0;
  Vec3<double> a_soon_W;  ///< of `kAhead` later, for the rates that the attitude will need
  double psi_soon = 0.0;
};
constexpr double kAhead = 0.01;  // s

/// What the vehicle can do; scenarios ask for no more.
struct Agility {
  double position_pole = 1.0, attitude_pole = 5.0, yaw_pole = 2.0, lift_pole = 1.0;  ///< rad/s
  double tilt_acceleration = 1.0;  ///< m/s^2 along the ground
  double lift_acceleration = 1.0;  ///< m/s^2
  double yaw_acceleration = 1.0;   ///< rad/s^2
  double motor_bandwidth = 10.0;   ///< rad/s
};

class Controller {
 public:
  /// `interval`: time from command to command, s.
  Controller(const Plant& plant, const Trim& trim, double interval);

  const Agility& agility() const { return agility_; }

  /// Commands for a state; remembers the integral of the position error.
  std::vector<double> command(const FlightState<double>& x, const Setpoint& to, double interval);

 private:
  struct Gains {
    double acceleration = 0.0, rate = 0.0, angle = 0.0;  ///< of the inner chain, by 1, 1/s, 1/s^2
    double velocity = 0.0, position = 0.0;               ///< of the outer one
  };
  void choose_poles(double delay);
  Vec3<double> wanted_force(const BodyState<double>& body, const Setpoint& to, double interval);
  Vec3<double> wanted_rotation(const BodyState<double>& body, const Setpoint& to, const Vec3<double>& f_W,
                               Vec3<double>& rate_B) const;
  Eigen::VectorXd allocated(const Eigen::Vector4d& wanted) const;

  Trim trim_;
  Eigen::Matrix<double, Eigen::Dynamic, 4> inverse_;  ///< of Trim::effect
  Eigen::VectorXd hover_squares_;
  double g_, km_, offset_, omega_m_, zeta_m_;
  bool lead_ = false;  ///< the command speeds up or damps the motor to w = omega_m, damping 1
  Agility agility_;
  Gains tilt_, yaw_, lift_;
  Vec3<double> integral_ = Vec3<double>::Zero();
};

}  // namespace ident
