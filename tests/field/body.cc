// Momentum balance, and a step of Runge-Kutta.
#include "body.h"

#include <cmath>

namespace field {
namespace {

Vector3d air_velocity(const Effects& e, const Motion& motion, const AirSample& air, const Vector3d& arm_B) {
  const Vector3d v_B = motion.q_WB.conjugate() * (motion.v_W - e.wind_W - air.v_W);
  return v_B + (motion.w_B - air.turning_B).cross(arm_B);
}

}  // namespace

std::vector<RotorLoad> rotor_loads(const Vehicle& v, const Effects& e, const Motion& motion,
                                   const RotorState& rotors, const AirSample& air) {
  std::vector<RotorLoad> loads;
  for (int i = 0; i < v.rotors(); ++i) {
    const Vector3d arm_B = v.hubs[static_cast<size_t>(i)].r_B - e.c_B;
    const double height = -(motion.p_W + motion.q_WB * arm_B).z();
    const RotorFlow flow{air_velocity(e, motion, air, arm_B), height,
                         e.propwash > 0 ? rotors.fluctuation[i] : 0};
    loads.push_back(rotor_load(v, e, i, rotors.Omega[i], flow));
  }
  return loads;
}

Eigen::Matrix3d inertia(const Vehicle& v, const Effects& e) {
  Eigen::Matrix3d J = v.J.asDiagonal();
  J(0, 1) = J(1, 0) = e.products[0];
  J(0, 2) = J(2, 0) = e.products[1];
  J(1, 2) = J(2, 1) = e.products[2];
  return J;
}

Acceleration accelerate(const Vehicle& v, const Effects& e, const Motion& motion, const RotorState& rotors,
                        const AirSample& air) {
  const std::vector<RotorLoad> loads = rotor_loads(v, e, motion, rotors, air);
  const Vector3d up(0, 0, -1);
  Vector3d F = Vector3d::Zero(), M = Vector3d::Zero();
  for (int i = 0; i < v.rotors(); ++i) {
    const Hub& hub = v.hubs[static_cast<size_t>(i)];
    const RotorLoad& load = loads[static_cast<size_t>(i)];
    const Vector3d f = (load.T + rotors.arm_force[i]) * up + load.across_B;
    F += f;
    M += (hub.r_B - e.c_B).cross(f) + load.hub_B - hub.s * load.Q * up;
    if (e.rotor_momentum) {
      M -= hub.s * v.Jp * (rotors.dOmega[i] * up + rotors.Omega[i] * motion.w_B.cross(up));
    }
  }
  const Vector3d u_B = air_velocity(e, motion, air, Vector3d::Zero());
  F -= u_B.norm() * e.C.cwiseProduct(u_B);
  const Eigen::Matrix3d J = inertia(v, e);
  return {F / v.m, J.ldlt().solve(M - motion.w_B.cross(J * motion.w_B))};
}

Motion advance(const Vehicle& v, const Effects& e, const Motion& motion, const Acceleration& a, double dt) {
  const Eigen::Matrix3d J = inertia(v, e);
  const auto spin = [&](const Vector3d& w) -> Vector3d { return w.cross(J * w); };
  const Vector3d middle = motion.w_B + 0.5 * dt * a.dw_B;
  const Vector3d dw = a.dw_B + J.ldlt().solve(spin(motion.w_B) - spin(middle));
  Motion next = motion;
  next.w_B += dt * dw;
  const Vector3d turn = dt * middle;
  const double angle = turn.norm();
  if (angle > 0) {
    next.q_WB = (motion.q_WB * Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle))).normalized();
  }
  const Eigen::Quaterniond half = motion.q_WB.slerp(0.5, next.q_WB);
  const Vector3d a_W = half * a.f_B + Vector3d(0, 0, kGravity);
  next.p_W += dt * motion.v_W + 0.5 * dt * dt * a_W;
  next.v_W += dt * a_W;
  return next;
}

}  // namespace field
