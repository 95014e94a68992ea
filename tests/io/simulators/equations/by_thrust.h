// Simulators whose motors are thrusts: PX4 SIH, MuJoCo, ArduPilot SITL, gym-pybullet-drones; and crazyflow,
// in rpm.
#pragma once

#include <fmt/format.h>

#include <numbers>

#include "ident/io/simulators/fields.h"
#include "support/manoeuvre.h"

namespace ident::test {

/// PX4 sih.cpp (039af95): generate_force_and_torques, quadrotor; forward, right, down there. The motor is u;
/// ident's command is its square root where rotor speed goes with the command.
inline SimulatorEquations sih_equations(const Fields& p) {
  using Eigen::Vector3d;
  const auto flip = [](const Vector3d& v) { return Vector3d(v.x(), -v.y(), -v.z()); };
  SimulatorEquations e{.m = p.number("SIH_MASS"), .g = 9.80665};
  const double xy = -p.number("SIH_IXY"), xz = -p.number("SIH_IXZ"), yz = p.number("SIH_IYZ");
  e.J << p.number("SIH_IXX"), xy, xz, xy, p.number("SIH_IYY"), yz, xz, yz, p.number("SIH_IZZ");
  e.tau_up = e.tau_down = p.number("SIH_T_TAU");
  e.target = [](double delta, std::size_t) { return delta * delta; };
  e.wrench = [=, &p](const SimulatorState& s, const std::vector<double>&) {
    const double T = p.number("SIH_T_MAX"), Q = p.number("SIH_Q_MAX");
    const std::vector<double>& u = s.motors;
    const Vector3d F(0, 0, -T * (u[0] + u[1] + u[2] + u[3]));
    const Vector3d M(p.number("SIH_L_ROLL") * T * (-u[0] + u[1] + u[2] - u[3]),
                     p.number("SIH_L_PITCH") * T * (u[0] - u[1] + u[2] - u[3]),
                     Q * (u[0] + u[1] - u[2] - u[3]));
    const Vector3d drag = -p.number("SIH_KDV") * (s.q.toRotationMatrix().transpose() * s.v);
    return SimulatorWrench{flip(F) + drag, flip(M)};
  };
  return e;
}

/// MuJoCo: motors at sites, ctrl is the thrust; gear 0 0 thrust 0 0 torque in the site's frame.
inline SimulatorEquations mujoco_equations(const Fields& p, std::size_t rotors) {
  using Eigen::Vector3d;
  SimulatorEquations e{.m = p.number("mass"), .g = -p.vector3("gravity").z()};
  const std::vector<double> J = p.numbers("fullinertia", 6);
  e.J << J[0], J[3], J[4], J[3], J[1], J[5], J[4], J[5], J[2];
  e.tau_up = e.tau_down = p.number("rotor1.dynprm");
  e.target = [&p](double delta, std::size_t n) {
    return delta * delta * p.numbers(fmt::format("rotor{}.ctrlrange", n + 1), 2)[1];
  };
  e.wrench = [=, &p](const SimulatorState& s, const std::vector<double>&) {
    SimulatorWrench out{Vector3d::Zero(), Vector3d::Zero()};
    for (std::size_t n = 0; n < rotors; ++n) {
      const std::string key = fmt::format("rotor{}.", n + 1);
      const std::vector<double> gear = p.numbers(key + "gear", 6);
      const Vector3d a = p.vector3(key + "zaxis").normalized(),
                     r = p.vector3(key + "pos") - p.vector3("inertial.pos");
      const Vector3d F = s.motors[n] * gear[2] * a;
      out.F += F;
      out.M += r.cross(F) + s.motors[n] * gear[5] * a;
    }
    return out;
  };
  return e;
}

/// ArduPilot SIM_Motor.cpp: thrust over the command and yaw torque 0.05 diagonal_size T c yaw; forward,
/// right, down.
inline SimulatorEquations ardupilot_equations(const Fields& p) {
  using Eigen::Vector3d;
  const auto flip = [](const Vector3d& v) { return Vector3d(v.x(), -v.y(), -v.z()); };
  SimulatorEquations e{.m = p.number("mass"), .g = 9.80665};
  e.J = p.vector3("moment_inertia").asDiagonal();
  e.target = [](double delta, std::size_t) { return delta; };
  e.wrench = [=, &p](const SimulatorState& s, const std::vector<double>&) {
    const Vector3d v = flip(s.q.toRotationMatrix().transpose() * s.v);
    const double n = p.number("num_motors"),
                 full = p.number("mass") * 9.80665 / (n * p.number("hoverThrOut"));
    const double e_ = p.number("propExpo"), ref = p.number("refSpd");
    const double drag =
        p.number("mass") * 9.80665 * std::tan(p.number("refAngle") * std::numbers::pi / 180) / (ref * ref);
    Vector3d F = -drag * v.norm() * v, M = Vector3d::Zero();
    for (std::size_t k = 0; k < s.motors.size(); ++k) {
      const std::string key = fmt::format("motor{}_", k + 1);
      const double c = s.motors[k], T = full * ((1 - e_) * c + e_ * c * c);
      const Vector3d thrust = T * p.vector3(key + "vector");
      F += thrust;
      M += p.vector3(key + "position").cross(thrust);
      M.z() += 0.05 * p.number("diagonal_size") * T * c * p.number(key + "yaw");
    }
    return SimulatorWrench{flip(F), flip(M)};
  };
  return e;
}

/// gym-pybullet-drones BaseAviary._physics: forces at the propellers' links, rpm follow at once.
inline SimulatorEquations pybullet_equations(const Fields& p) {
  using Eigen::Vector3d;
  SimulatorEquations e{.m = p.number("mass"), .g = 9.8};
  e.J = Vector3d(p.number("ixx"), p.number("iyy"), p.number("izz")).asDiagonal();
  const double max_rpm = std::sqrt(p.number("thrust2weight") * p.number("mass") * 9.8 / (4 * p.number("kf")));
  e.target = [=](double delta, std::size_t) { return delta * max_rpm; };
  e.wrench = [=, &p](const SimulatorState& s, const std::vector<double>&) {
    SimulatorWrench out{Vector3d::Zero(), Vector3d::Zero()};
    const double signs[] = {-1, 1, -1, 1};
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double rpm = s.motors[k];
      const Vector3d F(0, 0, p.number("kf") * rpm * rpm);
      out.F += F, out.M += p.vector3(fmt::format("prop{}.xyz", k)).cross(F);
      out.M.z() += signs[k] * p.number("km") * rpm * rpm;
      sum += 2 * std::numbers::pi * rpm / 60;
    }
    const Vector3d coefficient(p.number("drag_coeff_xy"), p.number("drag_coeff_xy"),
                               p.number("drag_coeff_z"));
    out.F += s.q.toRotationMatrix().transpose() * (-sum * coefficient.cwiseProduct(s.v));
    return out;
  };
  return e;
}

/// crazyflow first_principles/dynamics.py (026350d).
inline SimulatorEquations crazyflow_equations(const Fields& p) {
  using Eigen::Vector3d;
  SimulatorEquations e{.m = p.number("mass"), .g = 9.81};
  const std::vector<double> J = p.numbers("J", 9), thrust = p.numbers("rpm2thrust", 3),
                            torque = p.numbers("rpm2torque", 3);
  e.J = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(J.data());
  e.tau_up = 1 / p.numbers("rotor_dyn_coef", 4)[0], e.tau_down = 1 / p.numbers("rotor_dyn_coef", 4)[2];
  const auto rpm_of = [=](double T) {
    return (-thrust[1] + std::sqrt(thrust[1] * thrust[1] - 4 * thrust[2] * (thrust[0] - T))) /
           (2 * thrust[2]);
  };
  const double low = rpm_of(p.number("thrust_min")), high = rpm_of(p.number("thrust_max"));
  e.target = [=](double delta, std::size_t) { return low + (high - low) * delta; };
  e.wrench = [=, &p](const SimulatorState& s, const std::vector<double>& motors_dot) {
    const std::vector<double> mix = p.numbers("mixing_matrix", 12), drag = p.numbers("drag_matrix", 9);
    const double L = p.number("L"), to_rad = 2 * std::numbers::pi / 60;
    const Eigen::Matrix3d R = s.q.toRotationMatrix();
    SimulatorWrench out{
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(drag.data()) * (R.transpose() * s.v),
        Vector3d::Zero()};
    double turning = 0, speeding = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double rpm = s.motors[k], T = thrust[0] + thrust[1] * rpm + thrust[2] * rpm * rpm;
      out.F.z() += T;
      out.M += Vector3d(mix[k] * L * T, mix[4 + k] * L * T,
                        mix[8 + k] * (torque[0] + torque[1] * rpm + torque[2] * rpm * rpm));
      turning += mix[8 + k] * rpm * to_rad, speeding += mix[8 + k] * motors_dot[k] * to_rad;
    }
    out.M += p.number("prop_inertia") * Vector3d(-s.w.y() * turning, -s.w.x() * turning, speeding);
    return out;
  };
  return e;
}

}  // namespace ident::test
