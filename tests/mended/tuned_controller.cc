// The rule, with tau the motor lag of the model:
//
//   attitude      b = 0.6/tau within 2.2 and 6 rad/s; angle, rate and moment have the poles of
//                 (s^2 + 1.6 b s + b^2)(s + d), d = max(1/tau, 2.5 b)
//   velocity      b/3.2 level, b/2 upright; position that over 2.8
//   integrators   of position and attitude, so that constant errors of the model vanish in hover
//   feed-forward  hover thrust, drag at the reference's speed, rates and angular accelerations that the
//   reference needs
//
// Inertia, allocation and lag turn these rates into commands: nothing is tuned by hand.
#include "tuned_controller.h"

#include <algorithm>
#include <cmath>

namespace mended {

using Eigen::Quaterniond;
using Eigen::Vector4d;

namespace {

constexpr double kFastest = 6, kSlowest = 2.2;  // rad/s
constexpr double kAhead = 0.02;                 // s, for derivatives of the reference

// The attitude whose z axis is along the thrust, heading north.
Quaterniond upright_along(const Vector3d& thrust) {
  const Vector3d z = thrust.normalized(), y = z.cross(Vector3d::UnitX()).normalized();
  Eigen::Matrix3d R;
  R << y.cross(z), y, z;
  return Quaterniond(R);
}

Vector3d turn_between(const Quaterniond& from, const Quaterniond& to) {
  const Quaterniond turn = from.conjugate() * to;
  return 2 * (turn.w() < 0 ? -1 : 1) * turn.vec();
}

}  // namespace

TunedController::TunedController(const TargetModel& model, const References& references)
    : m_(model), references_(references) {
  for (std::size_t n = 0; n < kRotors; ++n) {
    const auto i = static_cast<Eigen::Index>(n);
    const TargetRotor& rotor = m_.rotors[n];
    allocation_(0, i) = rotor.kT * rotor.a.z();
    allocation_.block<3, 1>(1, i) = rotor.kT * rotor.r.cross(rotor.a) + rotor.kQ * rotor.a;
  }
  inverse_ = allocation_.inverse();
  const double tau = 0.5 * (m_.tau_up + m_.tau_down);
  b_ = std::clamp(0.6 / tau, kSlowest, kFastest);
  d_ = std::max(1 / tau, 2.5 * b_);
  motors_.fill(m_.hover_motor());
  const double most = m_.motor_target(1), hover = m_.hover_motor();
  const double spare = m_.by_speed ? std::pow(most / hover, 2) : most / hover;
  steepest_ = std::tan(std::clamp(std::acos(std::min(1.0, 1.15 / spare)), 0.28, 0.6));
}

Vector3d TunedController::thrust_for(const Aim& aim) const {
  return aim.a + Vector3d(0, 0, m_.g) + m_.drag_per_speed(aim.v.norm()) / m_.m * aim.v;
}

TunedController::Wanted TunedController::wanted(double t) const {
  const auto attitude = [&](double at) { return upright_along(thrust_for(references_.at(at))); };
  const Quaterniond before = attitude(t - kAhead), now = attitude(t), after = attitude(t + kAhead);
  const Vector3d w0 = turn_between(before, now) / kAhead, w1 = turn_between(now, after) / kAhead;
  return {now, 0.5 * (w0 + w1), (w1 - w0) / kAhead};
}

Vector3d TunedController::correction(const Aim& aim, const Belief& believed, double dt) {
  const double level = b_ / 3.2, upright = b_ / 2;
  const Vector3d kv(level, level, upright), kp = kv / 2.8, ki = 0.25 * kv.cwiseProduct(kp).cwiseProduct(kp);
  Vector3d error = aim.p - believed.p;
  const double far = 2.5 / kp.x();
  if (error.norm() > far) error *= far / error.norm();
  const Vector3d most = 4 * ki.cwiseInverse();  // m/s^2 over the gain
  position_sum_ = (position_sum_ + error * dt).cwiseMax(-most).cwiseMin(most);
  Vector3d a = kv.cwiseProduct(aim.v - believed.v + kp.cwiseProduct(error)) + ki.cwiseProduct(position_sum_);
  a.z() = std::clamp(a.z(), -0.5 * m_.g, 0.5 * m_.g);
  return a;
}

Vector4d TunedController::made(const Motors& motors) const {
  Vector4d power;
  for (std::size_t n = 0; n < kRotors; ++n)
    power[static_cast<Eigen::Index>(n)] = m_.by_speed ? motors[n] * motors[n] : motors[n];
  return allocation_ * power;
}

// Lift first, then roll and pitch as far as the rotors reach, then yaw.
Motors TunedController::limited(const Vector4d& demand) const {
  const double full = m_.motor_target(1), most = 0.97 * (m_.by_speed ? full * full : full),
               least = 0.03 * most;
  Vector4d result = inverse_ * Vector4d(std::max(demand[0], 0.0), 0, 0, 0);
  result = result.cwiseMax(1.5 * least).cwiseMin(0.93 * most);
  for (const Vector4d& part : {Vector4d(0, demand[1], demand[2], 0), Vector4d(0, 0, 0, demand[3])}) {
    const Vector4d extra = inverse_ * part;
    double share = 1;
    for (int i = 0; i < 4; ++i) {
      const double room = extra[i] > 0 ? most - result[i] : result[i] - least;
      if (std::abs(extra[i]) > 1e-12) share = std::min(share, std::max(room, 0.0) / std::abs(extra[i]));
    }
    result += share * extra;
  }
  Motors delta;
  for (std::size_t n = 0; n < kRotors; ++n)
    delta[n] = m_.command_for(result[static_cast<Eigen::Index>(n)] * m_.rotors[n].kT, n);
  return delta;
}

Motors TunedController::command(double t, const Belief& believed, double dt) {
  const Aim aim = references_.at(t);
  const Wanted reference = wanted(t);
  Vector3d thrust = thrust_for(aim) + correction(aim, believed, dt);
  const double level = thrust.head<2>().norm(), limit = steepest_ * thrust.z();
  if (level > limit) thrust.head<2>() *= limit / level;
  const Vector3d e = turn_between(upright_along(thrust), believed.q);
  attitude_sum_ = (attitude_sum_ + e * dt).cwiseMax(-3.0).cwiseMin(3.0);

  const Vector4d now = made(motors_);
  const Vector3d turning = m_.J_inverse * (Vector3d(now.tail<3>()) - believed.w.cross(m_.J * believed.w));
  const double tau = 0.5 * (m_.tau_up + m_.tau_down);
  Vector3d change;  // of angular acceleration
  for (int i = 0; i < 3; ++i) {
    const double b = i == 2 ? 0.5 * b_ : b_, p = 1.6 * b;
    const double a2 = p + d_, a1 = b * b + p * d_, a0 = b * b * d_;
    const double angle = i == 2 ? std::clamp(e[i], -0.5, 0.5) : e[i];
    change[i] = -a2 * (turning[i] - reference.dw[i]) - a1 * (believed.w[i] - reference.w[i]) -
                a0 * (angle + 0.25 * b * attitude_sum_[i]);
  }
  Vector4d demand;
  demand[0] = now[0] + tau * d_ * (m_.m * thrust.norm() - now[0]);
  demand.tail<3>() = Vector3d(now.tail<3>()) + tau * (m_.J * change);
  const Motors delta = limited(demand);
  Motors next, rate;
  m_.motors_after(motors_, delta, dt, next, rate);
  motors_ = next;
  return delta;
}

}  // namespace mended
