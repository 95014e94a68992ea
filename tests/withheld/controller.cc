// Pole placement on the chain angle, rate, angular acceleration, jerk: motors faster than the attitude loop
// keep their own poles, slower ones are led.
#include "controller.h"

#include <algorithm>
#include <cmath>

namespace withheld {

using Eigen::Vector3d;

Controller::Controller(const Vehicle& vehicle, double delay_margin) : v_(vehicle) {
  for (int i = 0; i < kRotors; ++i) {
    const Rotor& rotor = v_.rotors[static_cast<std::size_t>(i)];
    allocation_(0, i) = -rotor.a.z();
    allocation_.block<3, 1>(1, i) = rotor.r.cross(rotor.a) - rotor.s * v_.kQ / v_.kT * rotor.a;
  }
  inverse_ = allocation_.inverse();
  bandwidth_ = attitude_bandwidth(v_);
  if (delay_margin > 0) bandwidth_ = std::min(bandwidth_, 0.15 / delay_margin);
  const double spare = std::pow(v_.km / v_.hover_speed(), 2);  // thrust to weight
  steepest_ = std::tan(std::clamp(std::acos(1.15 / spare), 0.28, 0.5));
}

Vector3d Controller::wanted_acceleration(const Reference& reference, const Motion& believed, double dt) {
  const double level = bandwidth_ / 3.2, upright = bandwidth_ / 2;
  const Vector3d kv(level, level, upright), kp = kv / 2.8, ki = 0.25 * kv.cwiseProduct(kp).cwiseProduct(kp);
  Vector3d error = reference.p - believed.p;
  const double far = 2.5 / kp.x();  // a step of any size asks for no more than 2.5 m/s
  if (error.norm() > far) error *= far / error.norm();
  position_sum_ += error * dt;
  const Vector3d most = 3 * ki.cwiseInverse();
  position_sum_ = position_sum_.cwiseMax(-most).cwiseMin(most);
  const Vector3d v = reference.v - believed.v + kp.cwiseProduct(error);
  Vector3d a = reference.a + kv.cwiseProduct(v) + ki.cwiseProduct(position_sum_);
  a.z() = std::clamp(a.z(), -0.5 * v_.gravity, 0.5 * v_.gravity);
  return a;
}

Four Controller::command(const Reference& reference, const Motion& believed, const Four& Omega,
                         const Four& dOmega, double dt) {
  // Direction and size of thrust.
  const Vector3d wanted = wanted_acceleration(reference, believed, dt) - Vector3d(0, 0, v_.gravity);
  Vector3d level(wanted.x(), wanted.y(), 0);
  const double limit = -steepest_ * wanted.z();
  if (level.norm() > limit) level *= limit / level.norm();
  const Vector3d along = Vector3d(level.x(), level.y(), wanted.z());
  const Vector3d z_axis = -along.normalized();
  const Vector3d y_axis =
      z_axis.cross(Vector3d(std::cos(reference.yaw), std::sin(reference.yaw), 0)).normalized();
  Eigen::Matrix3d R;
  R << y_axis.cross(z_axis), y_axis, z_axis;
  const Eigen::Quaterniond turn = Eigen::Quaterniond(R).conjugate() * believed.q;
  const Vector3d e = 2 * (turn.w() < 0 ? -1 : 1) * turn.vec();
  const double lift = v_.m * along.norm();

  // What the rotors do now, and how fast that changes.
  const Four thrust = v_.kT * Omega.array().square(), rise = 2 * v_.kT * Omega.array() * dOmega.array();
  const Four now = allocation_ * thrust, change = allocation_ * rise;

  // Acceleration of the moment such that (s^2 + p s + b^2)(s^2 + d s + c^2) has the poles.
  const double w2 = v_.omega_m * v_.omega_m, dw = 2 * v_.zeta_m * v_.omega_m;
  const double c = std::max(v_.omega_m, 2.5 * bandwidth_), d = std::clamp(dw, 1.2 * c, 2.4 * c);
  attitude_sum_ = (attitude_sum_ + e * dt).cwiseMax(-0.6).cwiseMin(0.6);
  Four demand;
  for (int i = 0; i < 3; ++i) {
    const double b = bandwidth_ * (i == 2 ? 0.5 : 1.0), p = 1.6 * b;
    const double a3 = p + d, a2 = b * b + c * c + p * d, a1 = p * c * c + b * b * d, a0 = b * b * c * c;
    const double rate_error = believed.w[i] - (i == 2 ? reference.yaw_rate * R(2, 2) : 0.0);
    const double angle = i == 2 ? std::clamp(e[i], -0.5, 0.5) : e[i];
    const double second = -a3 * change[1 + i] / v_.J[i] - a2 * now[1 + i] / v_.J[i] - a1 * rate_error -
                          a0 * (angle + 0.25 * b * attitude_sum_[i]);
    demand[1 + i] = now[1 + i] + (dw * change[1 + i] + v_.J[i] * second) / w2;
  }
  demand[0] = now[0] + ((dw - d) * change[0] - c * c * (now[0] - lift)) / w2;

  // Lift first, then as much of the moments as the rotors have left; of the yaw moment at most half.
  const double most = v_.kT * v_.km * v_.km * 0.97, least = 0.03 * most;
  const Four base = inverse_ * Four(std::clamp(demand[0], 6 * least, 3.7 * most), 0, 0, 0);
  Four result = base;
  for (const Four& part : {Four(0, demand[1], demand[2], 0), Four(0, 0, 0, demand[3])}) {
    const Four extra = inverse_ * part;
    double share = 1;
    for (int i = 0; i < kRotors; ++i) {
      const double room = extra[i] > 0 ? most - result[i] : result[i] - least;
      if (std::abs(extra[i]) > 1e-12) share = std::min(share, std::max(room, 0.0) / std::abs(extra[i]));
    }
    result += share * extra;
  }
  const Four speed = (result.cwiseMax(least) / v_.kT).cwiseSqrt();
  return (speed / v_.km + reference.injected).cwiseMax(0.02).cwiseMin(1.0);
}

}  // namespace withheld
