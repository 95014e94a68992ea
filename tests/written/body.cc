// Momentum balance of a rigid body with four turning rotors in calm air, without drag.
#include "body.h"

namespace written {
namespace {

struct Rate {
  Vector3d v_W, a_W, dw_B;
  Eigen::Vector4d dq;
  PerRotor dOmega, ddOmega;
};

double lift(const Vehicle& v, const State& x) {
  double thrust = 0;
  for (const double Omega : x.Omega) thrust += v.kT * Omega * Omega;
  return thrust;
}

Vector3d moment(const Vehicle& v, const State& x) {
  const Vector3d a(0, 0, -1);
  Vector3d M = Vector3d::Zero();
  for (size_t n = 0; n < 4; ++n) {
    const auto& [r, s] = v.rotors[n];
    const double square = x.Omega[n] * x.Omega[n];
    M += r.cross(v.kT * square * a) - s * v.kQ * square * a;          // thrust and drag torque
    M -= s * v.Jp * (x.dOmega[n] * a + x.Omega[n] * x.w_B.cross(a));  // reaction and gyroscopic torque
  }
  return M;
}

Rate rate(const Vehicle& v, const State& x, const PerRotor& delta) {
  Rate d;
  for (size_t n = 0; n < 4; ++n) {  // [Phang 22]
    d.dOmega[n] = x.dOmega[n];
    d.ddOmega[n] =
        v.omega_m * v.omega_m * (v.km * delta[n] - x.Omega[n]) - 2 * v.zeta_m * v.omega_m * x.dOmega[n];
  }
  if (x.on_ground) {
    d.v_W = d.a_W = d.dw_B = Vector3d::Zero();
    d.dq.setZero();
    return d;
  }
  d.v_W = x.v_W;
  d.a_W = x.q_WB * Vector3d(0, 0, -lift(v, x) / v.m) + Vector3d(0, 0, kGravity);
  const Vector3d h = v.J.cwiseProduct(x.w_B);
  d.dw_B = (moment(v, x) - x.w_B.cross(h)).cwiseQuotient(v.J);
  const Eigen::Quaterniond turn(0, x.w_B.x(), x.w_B.y(), x.w_B.z());
  d.dq = 0.5 * (x.q_WB * turn).coeffs();
  return d;
}

State moved(const State& x, const Rate& d, double dt) {
  State y = x;
  y.p_W += dt * d.v_W, y.v_W += dt * d.a_W, y.w_B += dt * d.dw_B;
  y.q_WB.coeffs() += dt * d.dq;
  for (size_t n = 0; n < 4; ++n) y.Omega[n] += dt * d.dOmega[n], y.dOmega[n] += dt * d.ddOmega[n];
  return y;
}

void touch_ground(const Vehicle& v, State& x) {
  if (x.on_ground) {
    x.on_ground = lift(v, x) <= v.m * kGravity;
  } else if (x.p_W.z() >= 0 && x.v_W.z() > 0) {
    const Eigen::Matrix3d R = x.q_WB.toRotationMatrix();
    x.q_WB = Eigen::AngleAxisd(std::atan2(R(1, 0), R(0, 0)), Vector3d::UnitZ());
    x.p_W.z() = 0;
    x.v_W.setZero(), x.w_B.setZero();
    x.on_ground = true;
  }
}

}  // namespace

Vector3d specific_force(const Vehicle& v, const State& x) {
  if (x.on_ground) return x.q_WB.conjugate() * Vector3d(0, 0, -kGravity);
  return {0, 0, -lift(v, x) / v.m};
}

State advance(const Vehicle& v, const State& x, const PerRotor& delta) {
  const Rate k1 = rate(v, x, delta);
  const Rate k2 = rate(v, moved(x, k1, kStep / 2), delta);
  const Rate k3 = rate(v, moved(x, k2, kStep / 2), delta);
  const Rate k4 = rate(v, moved(x, k3, kStep), delta);
  State y = moved(moved(moved(moved(x, k1, kStep / 6), k2, kStep / 3), k3, kStep / 3), k4, kStep / 6);
  y.q_WB.normalize();
  touch_ground(v, y);
  return y;
}

}  // namespace written
