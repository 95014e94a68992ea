// Forces, moments and motors of a target.
#include "target_model.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace mended {

double TargetModel::motor_target(double delta) const {
  return by_speed ? low + (full - low) * delta : full * delta * delta;
}

double TargetModel::command_for(double thrust, std::size_t rotor) const {
  const double motor = std::max(thrust, 0.0) / rotors[rotor].kT;
  const double delta = by_speed ? (std::sqrt(motor) - low) / (full - low) : std::sqrt(motor / full);
  return std::clamp(delta, 0.0, 1.0);
}

void TargetModel::motors_after(const Motors& from, const Motors& delta, double h, Motors& out,
                               Motors& rate) const {
  for (std::size_t n = 0; n < kRotors; ++n) {
    const double aim = motor_target(delta[n]), tau = from[n] > aim ? tau_down : tau_up;
    out[n] = tau > 0 ? aim + (from[n] - aim) * std::exp(-h / tau) : aim;
    rate[n] = tau > 0 ? (aim - out[n]) / tau : 0.0;
  }
}

double TargetModel::hover_motor() const {
  double lift = 0;
  for (const TargetRotor& rotor : rotors) lift += rotor.kT * rotor.a.z();
  return by_speed ? std::sqrt(m * g / lift) : m * g / lift;
}

double TargetModel::drag_per_speed(double speed) const {
  const double of_rotors = by_speed ? kRotors * kd * hover_motor() : 0.0;
  return of_rotors + linear_drag + 0.5 * (c_D.x() + c_D.y()) * speed;
}

BodyWrench wrench(const TargetModel& p, const Vector3d& v_body, const Vector3d& w, const Motors& motors,
                  const Motors& motors_dot) {
  BodyWrench sum{-p.linear_drag * v_body - v_body.norm() * p.c_D.cwiseProduct(v_body), Vector3d::Zero()};
  for (std::size_t n = 0; n < kRotors; ++n) {
    const TargetRotor& rotor = p.rotors[n];
    const double x = motors[n], power = p.by_speed ? x * x : x;
    const Vector3d v = v_body + w.cross(rotor.r), along = v.dot(rotor.a) * rotor.a, across = v - along;
    Vector3d F = (rotor.kT * power + p.kh * across.squaredNorm()) * rotor.a;
    Vector3d M = rotor.kQ * power * rotor.a;
    if (p.by_speed) {
      F -= x * (p.kd * across + p.kz * along);
      M -= p.k_flap * x * v.cross(rotor.a);
      // A rotor that turns counter-clockwise moves the body clockwise.
      const double turning = rotor.kQ < 0 ? 1 : -1;
      M -= turning * p.momentum * (motors_dot[n] * rotor.a + x * w.cross(rotor.a));
    }
    sum.F += F;
    sum.M += rotor.r.cross(F) + M;
  }
  return sum;
}

double largest_mismatch(const TargetModel& model, const ident::test::SimulatorEquations& equations) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto random3 = [&](double size) {
    return Vector3d(size * uniform(engine), size * uniform(engine), size * uniform(engine));
  };
  const double weight = model.m * model.g, arm = model.rotors[0].r.norm(), hover = model.hover_motor();
  double most = std::abs(model.m / equations.m - 1) + (model.J - equations.J).norm() / model.J.norm() +
                std::abs(model.tau_up - equations.tau_up) + std::abs(model.tau_down - equations.tau_down) +
                std::abs(model.g - equations.g);
  for (int trial = 0; trial < 50; ++trial) {
    ident::test::SimulatorState s;
    s.v = random3(8), s.w = random3(4);
    s.q = Eigen::AngleAxisd(uniform(engine), random3(1).normalized());
    Motors motors{}, dot{};
    for (std::size_t n = 0; n < kRotors; ++n) {
      motors[n] = hover * (1 + 0.5 * uniform(engine)), dot[n] = 5 * hover * uniform(engine);
      s.motors.push_back(motors[n]);
      const double delta = 0.5 + 0.5 * uniform(engine);
      most = std::max(most, std::abs(model.motor_target(delta) - equations.target(delta, n)) / hover);
    }
    const BodyWrench ours = wrench(model, s.q.toRotationMatrix().transpose() * s.v, s.w, motors, dot);
    const auto theirs = equations.wrench(s, {dot.begin(), dot.end()});
    most = std::max({most, (ours.F - theirs.F).norm() / weight, (ours.M - theirs.M).norm() / (weight * arm)});
  }
  return most;
}

}  // namespace mended
