// Oscillators and bursts that are driven by the flight.
#include "outside.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace field {
namespace {
constexpr double kTwoPi = 2 * std::numbers::pi;
}

BendingArms::BendingArms(const Effects& e, int rotors, double dt)
    : w_(kTwoPi * e.arm_hz),
      damping_(e.arm_damping),
      dt_(dt),
      x_(PerRotor::Zero(rotors)),
      slope_(PerRotor::Zero(rotors)) {}

PerRotor BendingArms::advance(const std::vector<RotorLoad>& loads) {
  PerRotor T(x_.size());
  for (int i = 0; i < T.size(); ++i) T[i] = loads[static_cast<size_t>(i)].T;
  if (w_ == 0) return PerRotor::Zero(T.size());
  if (!started_) x_ = T;
  started_ = true;
  const PerRotor force = x_ + 2 * damping_ / w_ * slope_;
  slope_ += dt_ * (w_ * w_ * (T - x_) - 2 * damping_ * w_ * slope_);  // symplectic Euler
  x_ += dt_ * slope_;
  return force - T;
}

SloshingTank::SloshingTank(const Vehicle& v, const Effects& e, double dt)
    : share_(e.slosh_share),
      w_(kTwoPi * e.slosh_hz),
      dt_(dt),
      height_(0.3 * v.l),
      m_over_J_(v.m * v.J.cwiseInverse()) {}

Acceleration SloshingTank::advance(const Acceleration& rigid) {
  if (share_ == 0) return rigid;
  const double damping = 0.05;
  const Vector3d pull = w_ * w_ * x_ + 2 * damping * w_ * slope_;  // per swinging mass
  Acceleration a = rigid;
  const Vector3d across(rigid.f_B.x(), rigid.f_B.y(), 0);
  const Vector3d f = (across + share_ * pull) / (1 - share_);  // m f_rigid + share m pull = (1 - share) m f
  a.f_B.x() = f.x();
  a.f_B.y() = f.y();
  a.dw_B += share_ * m_over_J_.cwiseProduct(Vector3d(0, 0, -height_).cross(pull));
  const Vector3d turning = a.dw_B.cross(Vector3d(0, 0, -height_));
  slope_ += dt_ * (-f - Vector3d(turning.x(), turning.y(), 0) - pull);
  x_ += dt_ * slope_;
  return a;
}

Propwash::Propwash(const Vehicle& v, const Effects& e, Random random, double dt)
    : amplitude_(e.propwash),
      inflow_(v.hover_inflow()),
      dt_(dt),
      w_(kTwoPi * random.uniform(5, 11)),
      random_(random),
      x_(PerRotor::Zero(v.rotors())),
      slope_(PerRotor::Zero(v.rotors())) {}

PerRotor Propwash::advance(const Motion& motion, const Vector3d& wind_W) {
  if (amplitude_ == 0) return x_;
  const double damping = 0.35;
  for (int i = 0; i < x_.size(); ++i) {  // noise through a resonance, of unit variance
    const double drive = std::sqrt(4 * damping * w_ * w_ * w_ / dt_) * random_.normal();
    slope_[i] += dt_ * (drive - 2 * damping * w_ * slope_[i] - w_ * w_ * x_[i]);
    x_[i] += dt_ * slope_[i];
  }
  const Vector3d v_B = motion.q_WB.conjugate() * (motion.v_W - wind_W);
  const double sinking = v_B.z() / inflow_, across = v_B.head<2>().norm() / inflow_;
  const double active = std::clamp((sinking - 0.2) / 0.4, 0.0, 1.0) * std::exp(-across * across);
  return (amplitude_ * active) * x_;
}

}  // namespace field
