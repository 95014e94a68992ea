// Runge-Kutta over the equations of either side; motors of first order are solved exactly.
#include "support/manoeuvre.h"

#include <cmath>

#include "ident/effects/catalogue.h"
#include "ident/model/flight.h"

namespace ident::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kRow = 2e-3;  // s
constexpr int kSteps = 4;      // integrator steps a row

struct Rate {
  Vector3d x, v, w;
  Eigen::Vector4d q;
};

Rate rate_of(const SimulatorEquations& e, const SimulatorState& s, const std::vector<double>& motors_dot) {
  const SimulatorWrench total = e.wrench(s, motors_dot);
  const Vector3d w = s.w;
  const Quaterniond turned = s.q * Quaterniond(0.0, w.x(), w.y(), w.z());
  return {s.v, s.q.toRotationMatrix() * total.F / e.m - Vector3d(0, 0, e.g),
          e.J.inverse() * (total.M - w.cross(e.J * w)), 0.5 * turned.coeffs()};
}

SimulatorState moved(const SimulatorState& s, const Rate& k, double h) {
  SimulatorState next = s;
  next.x += h * k.x, next.v += h * k.v, next.w += h * k.w;
  next.q.coeffs() += h * k.q;
  return next;
}

std::vector<double> motors_after(const SimulatorEquations& e, const std::vector<double>& from,
                                 const std::vector<double>& delta, double h, std::vector<double>& rate) {
  std::vector<double> out(from.size());
  rate.resize(from.size());
  for (std::size_t n = 0; n < from.size(); ++n) {
    const double target = e.target(delta[n], n), tau = from[n] > target ? e.tau_down : e.tau_up;
    out[n] = tau > 0 ? target + (from[n] - target) * std::exp(-h / tau) : target;
    rate[n] = tau > 0 ? (target - out[n]) / tau : 0.0;
  }
  return out;
}

Eigen::Matrix<double, 13, 1> in_ned(const SimulatorState& s) {
  Eigen::Matrix<double, 13, 1> out;
  out << s.x.x(), -s.x.y(), -s.x.z(), s.v.x(), -s.v.y(), -s.v.z(), s.q.w(), s.q.x(), -s.q.y(), -s.q.z(),
      s.w.x(), -s.w.y(), -s.w.z();
  return out;
}

void step(const SimulatorEquations& e, SimulatorState& s, const std::vector<double>& delta, double h) {
  std::vector<double> dot0, dot1, dot2;
  motors_after(e, s.motors, delta, 0.0, dot0);
  const std::vector<double> middle = motors_after(e, s.motors, delta, h / 2, dot1),
                            end = motors_after(e, s.motors, delta, h, dot2);
  const auto with = [](SimulatorState state, const std::vector<double>& motors) {
    state.motors = motors;
    return state;
  };
  const Rate k1 = rate_of(e, s, dot0), k2 = rate_of(e, with(moved(s, k1, h / 2), middle), dot1),
             k3 = rate_of(e, with(moved(s, k2, h / 2), middle), dot1),
             k4 = rate_of(e, with(moved(s, k3, h), end), dot2);
  s.x += h / 6 * (k1.x + 2 * k2.x + 2 * k3.x + k4.x), s.v += h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v);
  s.w += h / 6 * (k1.w + 2 * k2.w + 2 * k3.w + k4.w),
      s.q.coeffs() += h / 6 * (k1.q + 2 * k2.q + 2 * k3.q + k4.q);
  s.q.normalize();
  s.motors = end;
}

}  // namespace

Manoeuvre hover_and_steps(const Vehicle& v) {
  const double n = static_cast<double>(v.rotors.size());
  const double hover = std::sqrt(v.value("m") * v.g / (n * v.value("kT")));
  const double idle = v.has("Omega_0") ? v.value("Omega_0") : 0.0, level = (hover - idle) / v.value("km");
  Manoeuvre out;
  for (int row = 0; row < 1250; ++row) {
    const double t = row * kRow;
    const auto doublet = [&](double from, double size) {
      return t < from || t >= from + 0.2 ? 0.0 : t < from + 0.1 ? size : -size;
    };
    std::vector<double> delta;
    for (const Rotor& r : v.rotors)
      delta.push_back(level + doublet(0.2, 0.02) * (r.r_B.y() < 0 ? 1 : -1) +
                      doublet(0.6, 0.02) * (r.r_B.x() > 0 ? 1 : -1) +
                      (t > 1.0 && t < 1.5 ? 0.03 * r.s : 0.0) + (t > 1.7 && t < 2.0 ? 0.05 : 0.0));
    out.delta.push_back(std::move(delta));
  }
  return out;
}

Manoeuvre fast_forward(const Vehicle& vehicle) {
  Manoeuvre out = hover_and_steps(vehicle);
  out.v_start = {9.0, 2.0, -1.0};
  return out;
}

Flown fly(const SimulatorEquations& e, const Manoeuvre& manoeuvre) {
  SimulatorState s;
  s.v = {manoeuvre.v_start.x(), -manoeuvre.v_start.y(), -manoeuvre.v_start.z()};
  for (std::size_t n = 0; n < manoeuvre.delta[0].size(); ++n)
    s.motors.push_back(e.target(manoeuvre.delta[0][n], n));
  Flown out;
  for (const std::vector<double>& delta : manoeuvre.delta) {
    for (int k = 0; k < kSteps; ++k) step(e, s, delta, kRow / kSteps);
    out.push_back(in_ned(s));
  }
  return out;
}

Flown fly(const Vehicle& vehicle, const Manoeuvre& manoeuvre) {
  const std::vector<double> p = parameter_vector(vehicle);
  const EffectSet<double> effects(p, active_effects(p));
  FlightInputs inputs;
  const std::size_t rotors = vehicle.rotors.size();
  inputs.delta.resize(rotors);
  for (std::size_t row = 0; row < manoeuvre.delta.size(); ++row)
    for (std::size_t n = 0; n < rotors; ++n)
      inputs.delta[n].append(static_cast<double>(row) * kRow, manoeuvre.delta[row][n]);
  Flight<double, EffectSet<double>> flight(vehicle, p, effects, inputs);
  FlightState<double> s;
  s.body.q_WB = {1, 0, 0, 0}, s.body.w_B = s.body.x_W = Vec3<double>(0, 0, 0);
  s.body.v_W = Vec3<double>(manoeuvre.v_start.x(), manoeuvre.v_start.y(), manoeuvre.v_start.z());
  for (std::size_t n = 0; n < rotors; ++n) s.motors[n] = {flight.steady_speed(n, 0.0), 0.0};
  Flown out;
  BodyRate<double> rate = flight.rate(s, 0.0);
  for (std::size_t row = 0; row < manoeuvre.delta.size(); ++row) {
    for (int k = 0; k < kSteps; ++k)
      flight.step_on(s, static_cast<double>(row) * kRow + k * kRow / kSteps, kRow / kSteps, rate);
    const BodyState<double>& b = s.body;
    Eigen::Matrix<double, 13, 1> line;
    line << b.x_W[0], b.x_W[1], b.x_W[2], b.v_W[0], b.v_W[1], b.v_W[2], b.q_WB[0], b.q_WB[1], b.q_WB[2],
        b.q_WB[3], b.w_B[0], b.w_B[1], b.w_B[2];
    line.segment<4>(6).normalize();
    out.push_back(line);
  }
  return out;
}

double largest_difference(const Flown& a, const Flown& b) {
  double most = a.size() == b.size() ? 0.0 : 1e9;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, (a[i] - b[i]).cwiseAbs().maxCoeff());
  return std::isfinite(most) ? most : 1e9;
}

}  // namespace ident::test
