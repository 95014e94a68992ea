// The instruments: what they show of the true motion, with the sensor effects of the case, and their noise.
#pragma once

#include "physics.h"
#include "random.h"

namespace withheld {

struct Instruments {
  double rate = 250;       // Hz, of rates, specific force, attitude, commands, rotor speeds
  int position_every = 5;  // rows
  int voltage_every = 25;
  double jitter = 0.02;  // of the period
  bool rotor_speeds = true, pulse_widths = true;
  double gyro = 0.005, acc = 0.1, attitude = 0.003, position = 0.003, velocity = 0.02;  // white, 1 sample
  double speed_share = 0.003;  // of hover speed, white
  double voltage_share = 0.002;
  double gyro_bias = 0.004;  // rad/s, turn-on, standard deviation over logs
  // Of an estimator: a slow error of the attitude about each axis, rad, that lasts so many seconds; a
  // constant one of the velocities, m/s, standard deviation over logs.
  double attitude_drift = 0, drift_time = 6, velocity_bias = 0;
  double filter = 0;  // Hz, cut-off of a Butterworth filter on rates and specific force as logged; 0: none
};

// An estimator shows attitude and velocity.
void make_estimator(Instruments* instruments, Random& random);
// An autopilot logs its rates and specific force filtered.
void make_filtered(Instruments* instruments, Random& random);

// Second-order Butterworth, three components.
class LowPass {
 public:
  explicit LowPass(double hz) : w_(2 * 3.14159265358979323846 * hz) {}
  // Over h seconds of the same input, by the implicit midpoint rule.
  void step(const Eigen::Vector3d& input, double h);
  const Eigen::Vector3d& value() const { return y_; }

 private:
  double w_;
  Eigen::Vector3d y_ = Eigen::Vector3d::Zero(), slope_ = Eigen::Vector3d::Zero();
};

Instruments draw_instruments(const Vehicle& vehicle, Random& random);

// Without noise: IMU place, turn, bias; `late` is the motion that delayed rates and attitude show.
struct Shown {
  Eigen::Vector3d gyro, acc;
  Eigen::Quaterniond q;
  Eigen::Vector3d p, v;
};
Shown show(const Effects& effects, const Motion& motion, const Motion& late,
           const Acceleration& acceleration);

Eigen::Quaterniond small_turn(const Eigen::Vector3d& angle);

}  // namespace withheld
