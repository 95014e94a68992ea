// Gains follow from the lag of the motors and of the gyro's filter.
#include "autopilot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace written {
namespace {

// Steady torque (roll, pitch, yaw in FRD) and lift under these inputs.
Eigen::Vector4d steady(const Vehicle& v, const Inputs& u) {
  const PerRotor delta = mix(v, u).delta;
  Eigen::Vector4d load = Eigen::Vector4d::Zero();
  for (size_t n = 0; n < 4; ++n) {
    const double Omega = v.km * delta[n], T = v.kT * Omega * Omega;
    const Rotor& rotor = v.rotors[n];
    load += Eigen::Vector4d(-rotor.r_B.y() * T, rotor.r_B.x() * T, rotor.s * v.kQ * Omega * Omega, T);
  }
  return load;
}

double hover_input(const Vehicle& v) {
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (steady(v, {0, 0, 0, middle})[3] > v.m * kGravity ? high : low) = middle;
  }
  return high;
}

}  // namespace

Autopilot::Autopilot(const Vehicle& v) : v_(v), hover_(hover_input(v)) {
  const Vector3d signs = firmware_signs(v.stack);
  for (int axis = 0; axis < 4; ++axis) {
    Inputs up(0, 0, 0, hover_), down = up;
    const double sign = axis < 3 ? signs[axis] : 1, size = 0.04;
    up[axis] += sign * size, down[axis] -= sign * size;
    effect_[axis] = (steady(v, up) - steady(v, down))[axis] / (2 * size);
  }
  const double lag = 2 * v.zeta_m / v.omega_m + std::numbers::sqrt2 / (2 * std::numbers::pi * v.gyro_hz);
  rate_gain_ = 0.55 / lag;
  attitude_gain_ = std::min(8.0, rate_gain_ / 2.2);
  velocity_gain_ = attitude_gain_ / 3;
}

SetPoints Autopilot::run(const Reading& reading, const Wish& wish, double dt) {
  SetPoints out;
  Vector3d target = wish.v_W;
  if (wish.hold_height) target.z() = std::clamp(-1.0 * (wish.height + reading.p_W.z()), -1.5, 1.5);
  const Vector3d error = target - reading.v_W;
  velocity_integral_ += error * velocity_gain_ * 0.4 * dt;
  velocity_integral_ = velocity_integral_.cwiseMin(3).cwiseMax(-3);
  Vector3d a = velocity_gain_ * error + velocity_integral_;
  const double level = a.head<2>().norm();
  if (level > 5) a.head<2>() *= 5 / level;

  yaw_ += wish.yaw_rate * dt;
  const Eigen::AngleAxisd heading(yaw_, Vector3d::UnitZ());
  const Vector3d tilt = heading.inverse() * a;
  out.euler = {tilt.y() / kGravity + wish.roll, -tilt.x() / kGravity + wish.pitch, yaw_};
  const Eigen::Quaterniond q_wish = heading * Eigen::AngleAxisd(out.euler.y(), Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(out.euler.x(), Vector3d::UnitX());
  Eigen::Quaterniond turn = reading.q_WB.conjugate() * q_wish;
  if (turn.w() < 0) turn.coeffs() *= -1;
  out.rate = attitude_gain_ * 2 * turn.vec() + wish.rate;
  out.rate.z() = std::clamp(out.rate.z(), -2.0, 2.0);

  const Vector3d lack = out.rate - reading.gyro;
  rate_integral_ += lack * rate_gain_ * 0.5 * dt;
  rate_integral_ = rate_integral_.cwiseMin(5).cwiseMax(-5);
  const Vector3d gain(rate_gain_, rate_gain_, rate_gain_ * 0.5);
  const Vector3d torque = v_.J.cwiseProduct(gain.cwiseProduct(lack) + rate_integral_);
  const double up = std::max(0.6, (reading.q_WB * Vector3d::UnitZ()).z());
  const double lift = v_.m * (kGravity - a.z()) / up;
  const Vector3d signs = firmware_signs(v_.stack);
  for (int axis = 0; axis < 3; ++axis)
    out.inputs[axis] = signs[axis] * std::clamp(torque[axis] / effect_[axis], -0.2, 0.2);
  out.inputs[3] = std::clamp(hover_ + (lift - v_.m * kGravity) / effect_[3], 0.05, 0.9);
  return out;
}

}  // namespace written
