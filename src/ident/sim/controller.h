// The simulator's own controller: flies any vehicle with a bandwidth that follows its motors.
//
// A reference (position and its derivatives, heading) gives attitude, rates and rotor speeds that would
// follow it without lag; the deviations from those go through the regulator's gain; what the rotors cannot
// give is shed in the order yaw, lift, roll and pitch. It knows the state it is given, the true one or
// nearly: what flies matters here, not how an estimator would help it.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "ident/sim/regulator.h"

namespace ident {

constexpr double kAhead = 0.01;  // s

/// Where the vehicle should be.
struct Setpoint {
  Vec3<double> x_W, v_W, a_W;
  double psi = 0.0;
  Vec3<double> a_soon_W;  ///< of `kAhead` later, for the rates that the attitude will need
  double psi_soon = 0.0;
};

/// What the vehicle can do; scenarios ask for no more.
struct Agility {
  double attitude_bandwidth = 5.0;                                             ///< rad/s
  double position_bandwidth = 1.0, lift_bandwidth = 1.0, yaw_bandwidth = 1.0;  ///< rad/s
  double tilt_acceleration = 1.0;                                              ///< m/s^2 along the ground
  double lift_acceleration = 1.0;                                              ///< m/s^2
  double yaw_acceleration = 1.0;                                               ///< rad/s^2
};

class Controller {
 public:
  /// `interval`: time from command to command, s.
  Controller(const Plant& plant, const Trim& trim, double height, double interval);

  const Agility& agility() const { return agility_; }

  /// Commands for a state; remembers the integral of the position error.
  std::vector<double> command(const FlightState<double>& x, const Setpoint& to, double interval);
  /// What was given to the rotors in the end; with dead time it is still to come.
  void given(std::span<const double> delta);

 private:
  struct Reference {
    Vec4<double> q_WB;
    Vec3<double> w_B;
    double level = 1.0;  ///< lift over that of hover
  };
  void judge_agility(double delay);
  Reference reference(const Setpoint& to) const;
  Eigen::VectorXd deviation(const FlightState<double>& x, const Setpoint& to, const Reference& reference);
  Eigen::VectorXd shed(const Eigen::VectorXd& base, const Eigen::VectorXd& change) const;

  Trim trim_;
  LinearModel model_;
  Eigen::MatrixXd gain_;
  Eigen::Matrix<double, 4, Eigen::Dynamic> effect_;   ///< of commands on w_B' and on the lift
  Eigen::Matrix<double, Eigen::Dynamic, 4> inverse_;  ///< of `effect_`
  double g_, km_, offset_, omega_m_, zeta_m_;
  Agility agility_;
  Vec3<double> trail_W_ = Vec3<double>::Zero();  ///< integral of the position error, by its bandwidth
  std::deque<Eigen::VectorXd> under_way_;        ///< commands given, latest first
};

}  // namespace ident
