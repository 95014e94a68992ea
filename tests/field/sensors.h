// What a log shows: filtered IMU, estimator or motion capture, ESC telemetry, voltage; each at its own rate.
#pragma once

#include <array>
#include <vector>

#include "autopilot.h"

namespace field {

struct Instruments {
  double physics_hz = 2000, log_hz = 250;
  // One sample in so many rows.
  int command_every = 1, attitude_every = 1, position_every = 1, speed_every = 1;
  bool rotor_speeds = false, voltage = true, euler = false, pulses = false, empty_cells = false,
       estimator = false;
  int gyro_order = 2, accel_order = 2;                                // 0: no filter
  double gyro_hz = 80, accel_hz = 40;                                 // cut-off
  double imu_delay = 0;                                               // s, beside the filters
  double gyro_noise = 0, accel_noise = 0;                             // of one raw sample: rad/s, m/s^2
  double attitude_noise = 0, attitude_drift = 0, drift_time = 5;      // rad, rad, s
  double velocity_noise = 0, velocity_drift = 0, position_noise = 0;  // m/s, m/s, m
  double outside_delay = 0;                                           // s, of attitude, position and velocity
  double speed_noise = 0;                                             // relative, of rotor speeds
  double speed_delay = 0;                                             // s
  double gyro_sigma() const;                                          // of a logged sample
  double accel_sigma() const;
  double gyro_delay() const;  // s, at low frequency
};
Instruments draw_instruments(Random& random, const Vehicle& v, bool plain);

// Truth at one physics step, as far as sensors feel it.
struct Truth {
  double t = 0;
  Motion motion;
  Acceleration a;
  PerRotor Omega, command;
  double voltage = 0;
};

struct Row {
  double t = 0;
  PerRotor command, Omega;
  Vector3d gyro, accel, p_W, v_W;
  Eigen::Quaterniond q_WB;
  double voltage = 0;
  bool has_command = true, has_attitude = true, has_position = true, has_speeds = true;
};

class Sensors {
 public:
  Sensors(const Vehicle& v, const Effects& e, const Instruments& instruments, Random random);
  void step(const Truth& truth);  // at physics_hz
  Row row(double t, long number, const PerRotor& command);
  Vector3d raw_gyro() const { return raw_gyro_; }

 private:
  struct Outside {
    Vector3d p_W, v_W;
    Eigen::Quaterniond q_WB;
  };
  void imu(const Truth& truth);
  void drift();

  const Vehicle& v_;
  const Effects& e_;
  Instruments in_;
  Random random_;
  LowPass gyro_filter_, accel_filter_;
  Delay<Vector3d> gyro_delay_, accel_delay_;
  Delay<Outside> outside_delay_;
  Delay<PerRotor> speed_delay_;
  Eigen::Matrix3d imu_from_body_;
  Vector3d gyro_bias_, raw_gyro_ = Vector3d::Zero(), gyro_, accel_;
  Vector3d attitude_drift_ = Vector3d::Zero(), velocity_drift_ = Vector3d::Zero();
  Vector3d position_drift_ = Vector3d::Zero();
  Outside outside_;
  PerRotor Omega_, phase_;
  std::vector<Vector3d> shake_;
  double voltage_ = 0;
  Row held_;
  int command_phase_ = 0;
};

}  // namespace field
