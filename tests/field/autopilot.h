// A flight controller: cascade of position, velocity, attitude and rate, mixer, battery compensation.
#pragma once

#include "body.h"
#include "filters.h"
#include "plan.h"

namespace field {

struct Tuning {
  double loop_hz = 1000;      // of rates and mixer
  double outer_hz = 50;       // of position and velocity
  double gyro_hz = 80;        // cut-off of the filter before the rate loop, second order
  double derivative_hz = 40;  // of the D-term
  double rate_gain = 0, attitude_gain = 0, velocity_gain = 0, position_gain = 0;  // 1/s
  double derivative = 0.4;
  double believed_kT = 0, believed_m = 0;  // what the controller takes for true
  Vector3d believed_J = Vector3d::Zero();
  bool battery_compensation = true;
  double idle = 0.05;
};
Tuning draw_tuning(Random& random, const Vehicle& v);

// What the controller is shown.
struct Reading {
  Vector3d gyro_B = Vector3d::Zero();
  Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero();
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  double voltage = 0;
};

class Autopilot {
 public:
  Autopilot(const Vehicle& v, const Tuning& tuning, const Vector3d& w_B);
  // Called at loop_hz: commands to the ESCs, 0 to 1.
  PerRotor update(const Reading& reading, const SetPoint& target);
  double saturated_share() const {
    return updates_ > 0 ? static_cast<double>(saturated_) / static_cast<double>(updates_) : 0;
  }

 private:
  void outer_loop(const Reading& reading, const SetPoint& target);
  Vector3d rate_loop(const Reading& reading, const SetPoint& target);  // torque, N m
  PerRotor mix(double collective, const Vector3d& torque);             // thrusts, N
  PerRotor command(const PerRotor& thrusts, double voltage) const;

  const Vehicle& v_;
  Tuning tuning_;
  Eigen::Matrix<double, Eigen::Dynamic, 4> allocation_;
  LowPass gyro_filter_, derivative_filter_;
  Vector3d a_W_ = Vector3d::Zero(), velocity_integral_ = Vector3d::Zero();
  Vector3d rate_integral_ = Vector3d::Zero(), last_gyro_;
  double voltage_ = 0;
  long ticks_ = 0, updates_ = 0, saturated_ = 0;
};

}  // namespace field
