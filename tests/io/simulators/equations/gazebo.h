// The equations of gz-sim's MulticopterMotorModel.cc (93bbf3e) on a body that the physics engine puts
// together.
//
// Classic's gazebo_motor_model.cpp differs by the factor (1 - v_parallel/maxRelativeAirspeed) on the thrust.
#pragma once

#include <fmt/format.h>

#include "ident/io/simulators/fields.h"
#include "support/manoeuvre.h"

namespace ident::test {

inline Eigen::Matrix3d turned_by(const std::vector<double>& pose) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(pose[5], Vector3d::UnitZ()) * AngleAxisd(pose[4], Vector3d::UnitY()) *
          AngleAxisd(pose[3], Vector3d::UnitX()))
      .toRotationMatrix();
}

/// `s.x` and `s.v` are those of the centre of gravity.
inline SimulatorEquations gazebo_equations(const Fields& p, std::size_t rotors) {
  using Eigen::Matrix3d, Eigen::Vector3d;
  struct Link {
    double m;
    Vector3d r;
    Matrix3d J;
  };
  std::vector<Link> links;
  std::vector<Vector3d> hubs, axes;
  const auto inertia = [&](const std::string& key) {
    Matrix3d J;
    const auto at = [&](const char* name) { return p.number(key + name, 0.0); };
    J << at("ixx"), at("ixy"), at("ixz"), at("ixy"), at("iyy"), at("iyz"), at("ixz"), at("iyz"), at("izz");
    return J;
  };
  const std::vector<double> base = p.numbers("base.inertial", 6);
  links.push_back({p.number("base.mass"), {base[0], base[1], base[2]}, inertia("base.")});
  for (std::size_t n = 0; n < rotors; ++n) {
    const std::string key = fmt::format("rotor{}.", n + 1);
    const std::vector<double> pose = p.numbers(key + "pose", 6);
    const Matrix3d R = turned_by(pose);
    hubs.push_back({pose[0], pose[1], pose[2]}), axes.push_back(R.col(2));
    links.push_back({p.number(key + "mass"), hubs.back(), R * inertia(key) * R.transpose()});
  }
  SimulatorEquations e{.m = 0.0, .g = 9.8, .J = Matrix3d::Zero()};
  Vector3d c = Vector3d::Zero();
  for (const Link& link : links) e.m += link.m, c += link.m * link.r;
  c /= e.m;
  for (const Link& link : links) {
    const Vector3d r = link.r - c;
    e.J += link.J + link.m * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
  }
  e.tau_up = p.number("rotor1.timeConstantUp"), e.tau_down = p.number("rotor1.timeConstantDown");
  e.target = [&p](double delta, std::size_t n) {
    return delta * p.number(fmt::format("rotor{}.maxRotVelocity", n + 1));
  };
  e.wrench = [=, &p](const SimulatorState& s, const std::vector<double>& motors_dot) {
    SimulatorWrench out{Vector3d::Zero(), Vector3d::Zero()};
    const Vector3d v_body = s.q.toRotationMatrix().transpose() * s.v;
    for (std::size_t n = 0; n < rotors; ++n) {
      const auto at = [&](const char* name) { return p.number(fmt::format("rotor{}.{}", n + 1, name)); };
      const double turning = p.word(fmt::format("rotor{}.turningDirection", n + 1), "") == "ccw" ? 1.0 : -1.0,
                   speed = s.motors[n];
      const Vector3d r = hubs[n] - c, v = v_body + s.w.cross(r), a = axes[n], across = v - v.dot(a) * a;
      double thrust = speed * speed * at("motorConstant");
      if (p.has("rotor1.maxRelativeAirspeed"))
        thrust *= std::clamp(1.0 - v.dot(a) / at("maxRelativeAirspeed"), 0.0, 1.0);
      const Vector3d F = thrust * a - std::abs(speed) * at("rotorDragCoefficient") * across;
      // The joint turns at speed/rotorVelocitySlowdownSim; its momentum is that of the link.
      const double share = turning * at("izz") / at("rotorVelocitySlowdownSim");
      out.F += F;
      out.M += r.cross(F) - turning * thrust * at("momentConstant") * a -
               share * (motors_dot[n] * a + speed * s.w.cross(a));
    }
    return out;
  };
  return e;
}

}  // namespace ident::test
