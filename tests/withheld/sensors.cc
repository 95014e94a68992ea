// The instruments and how good they are; one drawn set serves both logs of a case.
#include "sensors.h"

#include <array>
#include <cmath>

namespace withheld {

Instruments draw_instruments(const Vehicle&, Random& random) {
  Instruments i;
  const std::array<double, 6> rates = {100, 200, 250, 250, 250, 500};
  i.rate = rates[static_cast<std::size_t>(random.integer(0, 5))];
  const double position_rate = random.chance(0.5) ? 50 : 100;
  i.position_every = std::max(1, static_cast<int>(i.rate / position_rate));
  i.voltage_every = static_cast<int>(i.rate / 10);
  i.jitter = random.uniform(0, 0.05);
  i.rotor_speeds = random.chance(0.75);
  i.pulse_widths = random.chance(0.5);
  i.gyro = random.log_uniform(0.002, 0.02);
  i.acc = random.log_uniform(0.03, 0.3);
  i.attitude = random.log_uniform(0.001, 0.007);
  i.position = random.log_uniform(0.001, 0.03);
  i.velocity = random.log_uniform(0.008, 0.06);
  i.speed_share = random.log_uniform(0.001, 0.006);
  i.voltage_share = random.uniform(0.001, 0.003);
  i.gyro_bias = random.log_uniform(0.001, 0.01);
  return i;
}

void make_estimator(Instruments* instruments, Random& random) {
  instruments->attitude_drift = random.log_uniform(0.001, 0.008);
  instruments->drift_time = random.log_uniform(3, 15);
  instruments->velocity_bias = random.log_uniform(0.005, 0.08);
}

void make_filtered(Instruments* instruments, Random& random) {
  instruments->filter = random.log_uniform(35, 90);
}

void LowPass::step(const Eigen::Vector3d& input, double h) {
  const double a = h / 2, damped = std::sqrt(2.0) * w_ * a + a * a * w_ * w_;
  const Eigen::Vector3d before = slope_;
  slope_ = ((1 - damped) * before + 2 * a * w_ * w_ * (input - y_)) / (1 + damped);
  y_ += a * (before + slope_);
}

Eigen::Quaterniond small_turn(const Eigen::Vector3d& angle) {
  const double size = angle.norm();
  if (size < 1e-12)
    return Eigen::Quaterniond(1, 0.5 * angle.x(), 0.5 * angle.y(), 0.5 * angle.z()).normalized();
  return Eigen::Quaterniond(Eigen::AngleAxisd(size, angle / size));
}

Shown show(const Effects& e, const Motion& motion, const Motion& late, const Acceleration& acceleration) {
  const Eigen::Quaterniond to_imu = small_turn(e.imu_turn).conjugate();
  const Eigen::Vector3d at_imu =
      acceleration.f + acceleration.dw.cross(e.imu_at) + motion.w.cross(motion.w.cross(e.imu_at));
  return {to_imu * late.w, to_imu * at_imu + e.acc_bias, late.q, motion.p, motion.v};
}

}  // namespace withheld
