// The loops from position to motor commands.
#include "autopilot.h"

#include <algorithm>
#include <cmath>

namespace field {
namespace {

Vector3d clamp_each(const Vector3d& x, const Vector3d& limit) { return x.cwiseMin(limit).cwiseMax(-limit); }

Vector3d shorten(const Vector3d& x, double limit) {
  return x.norm() > limit ? Vector3d(x * limit / x.norm()) : x;
}

}  // namespace

Tuning draw_tuning(Random& random, const Vehicle& v) {
  Tuning t;
  t.loop_hz = random.pick({500.0, 1000.0, 2000.0});
  t.outer_hz = random.pick({50.0, 100.0});
  t.gyro_hz = random.uniform(60, 120);
  t.derivative_hz = random.uniform(25, 50);
  const double lag = v.lag() + v.latency + group_delay(2, t.gyro_hz);
  t.rate_gain = std::min(30.0, random.uniform(0.5, 0.75) / lag);
  t.attitude_gain = std::min(8.0, t.rate_gain / random.uniform(3.0, 4.0));
  t.velocity_gain = t.attitude_gain / random.uniform(2.6, 3.5);
  t.position_gain = t.velocity_gain / random.uniform(2.2, 3.0);
  t.derivative = random.uniform(0.2, 0.5);
  t.believed_kT = v.kT * random.uniform(0.85, 1.15);
  t.believed_m = v.m * random.uniform(0.95, 1.05);
  t.believed_J = v.J * random.uniform(0.85, 1.15);
  t.battery_compensation = random.chance(0.7);
  return t;
}

Autopilot::Autopilot(const Vehicle& v, const Tuning& tuning, const Vector3d& w_B)
    : v_(v),
      tuning_(tuning),
      allocation_(v.rotors(), 4),
      gyro_filter_(2, tuning.gyro_hz, tuning.loop_hz),
      derivative_filter_(1, tuning.derivative_hz, tuning.loop_hz),
      last_gyro_(w_B) {
  Eigen::Matrix<double, 4, Eigen::Dynamic> effect(4, v.rotors());
  for (int i = 0; i < v.rotors(); ++i) {
    const Hub& hub = v.hubs[static_cast<size_t>(i)];
    effect.col(i) << 1, -hub.r_B.y(), hub.r_B.x(), hub.s * v.kQ / v.kT;
  }
  allocation_ = effect.completeOrthogonalDecomposition().pseudoInverse();
}

void Autopilot::outer_loop(const Reading& reading, const SetPoint& target) {
  const Vector3d want = target.v_W + shorten(tuning_.position_gain * (target.p_W - reading.p_W), 3.0);
  const Vector3d error = want - reading.v_W;
  velocity_integral_ += error / tuning_.outer_hz * tuning_.velocity_gain * 0.4;
  velocity_integral_ = clamp_each(velocity_integral_, Vector3d(4, 4, 5));
  Vector3d a = target.a_W + tuning_.velocity_gain * error + velocity_integral_;
  const double most = 0.8 * kGravity;  // 39 deg of tilt
  const double level = a.head<2>().norm();
  if (level > most) a.head<2>() *= most / level;
  a.z() = std::clamp(a.z(), -0.5 * kGravity, 0.5 * kGravity);
  a_W_ = a;
}

Vector3d Autopilot::rate_loop(const Reading& reading, const SetPoint& target) {
  const Vector3d z_B = (Vector3d(0, 0, kGravity) - a_W_).normalized();
  const Vector3d heading(std::cos(target.yaw), std::sin(target.yaw), 0);
  const Vector3d y_B = z_B.cross(heading).normalized();
  Eigen::Matrix3d R;
  R << y_B.cross(z_B), y_B, z_B;
  const Vector3d tilt = target.tilt_B;
  const Eigen::Quaterniond wanted =
      Eigen::Quaterniond(R) * Eigen::Quaterniond(1, 0.5 * tilt.x(), 0.5 * tilt.y(), 0).normalized();
  Eigen::Quaterniond error = reading.q_WB.conjugate() * wanted;
  if (error.w() < 0) error.coeffs() *= -1;
  Vector3d w_wanted = 2 * tuning_.attitude_gain * error.vec();
  w_wanted.z() = 0.4 * w_wanted.z() + target.yaw_rate;
  w_wanted = clamp_each(w_wanted, Vector3d(5, 5, 2.5));

  const double dt = 1 / tuning_.loop_hz;
  const Vector3d gyro = gyro_filter_(reading.gyro_B);
  const Vector3d slope = derivative_filter_((gyro - last_gyro_) / dt);
  last_gyro_ = gyro;
  const Vector3d e = w_wanted - gyro;
  const Vector3d gain = tuning_.rate_gain * Vector3d(1, 1, 0.3);
  rate_integral_ = clamp_each(rate_integral_ + dt * 1.5 * gain.cwiseProduct(e), Vector3d(40, 40, 10));
  const Vector3d dw =
      gain.cwiseProduct(e) + rate_integral_ - tuning_.derivative * Vector3d(slope.x(), slope.y(), 0);
  return tuning_.believed_J.cwiseProduct(dw);
}

PerRotor Autopilot::mix(double collective, const Vector3d& torque) {
  const double full = tuning_.believed_kT * std::pow(v_.km + v_.Omega_0, 2);
  const double least = tuning_.believed_kT * std::pow(v_.km * tuning_.idle + v_.Omega_0, 2);
  const Eigen::VectorXd turn = allocation_ * Eigen::Vector4d(0, torque.x(), torque.y(), 0);
  Eigen::VectorXd yaw = allocation_ * Eigen::Vector4d(0, 0, 0, torque.z());
  const double per_rotor = collective / v_.rotors();
  const double room =
      std::max(0.03 * full, std::min(full - per_rotor, per_rotor - least) - turn.cwiseAbs().maxCoeff());
  const double most = yaw.cwiseAbs().maxCoeff();
  if (most > room) yaw *= room / most;  // roll and pitch go first
  Eigen::VectorXd thrust = Eigen::VectorXd::Constant(v_.rotors(), per_rotor) + turn + yaw;
  const double above = thrust.maxCoeff() - full, below = least - thrust.minCoeff();
  if (above > 0) thrust.array() -= above;
  if (below > 0 && above <= 0) thrust.array() += below;
  ++updates_;
  if (above > 0 || below > 0) ++saturated_;
  return thrust.array().max(least).min(full);
}

PerRotor Autopilot::command(const PerRotor& thrusts, double voltage) const {
  PerRotor delta = ((thrusts / tuning_.believed_kT).sqrt() - v_.Omega_0) / v_.km;
  if (tuning_.battery_compensation) delta *= v_.battery.reference / voltage;
  return delta.max(tuning_.idle).min(1.0);
}

PerRotor Autopilot::update(const Reading& reading, const SetPoint& target) {
  const long every = std::lround(tuning_.loop_hz / tuning_.outer_hz);
  if (ticks_++ % every == 0) outer_loop(reading, target);
  if (voltage_ == 0) voltage_ = reading.voltage;
  voltage_ += (reading.voltage - voltage_) / (0.5 * tuning_.loop_hz);  // filtered over half a second
  const Vector3d up_W = reading.q_WB * Vector3d(0, 0, -1);
  const double collective =
      tuning_.believed_m * std::max(0.2 * kGravity, up_W.dot(a_W_ - Vector3d(0, 0, kGravity)));
  return command(mix(collective, rate_loop(reading, target)), voltage_);
}

}  // namespace field
