// The vehicle's model, evaluated half way between rows of measured flight and summed up by the midpoint rule.
//
// Motors are faster than the rows: between two of them a rotor counts with
//
//   Omega^2 = mean of Omega^2,   Omega_dot = (Omega(end) - Omega(begin))/h
//
// which are exact for thrust, torque and the rotor's own inertia.
#include "ident/flight/ladder/model_along.h"

#include <algorithm>
#include <cmath>

#include "ident/core/stage_times.h"
#include "ident/effects/all_parameters.h"
#include "ident/flight/record/motor_start.h"

namespace ident {
namespace {

constexpr double kBelieved = 0.5;  // share of the difference to a measured speed that a motor takes over

constexpr double kStep = 0.004;  // s: short against the lag of any motor

using Model = Flight<double, EffectSet<double>>;
using Motors = MotorsAlong::Motors;

// Takes motors on from `t` by `h`; what they were in between.
Motors advanced(Model& flight, Motors& motors, double t, double h, std::size_t rotors) {
  const int steps = std::max(1, static_cast<int>(std::lround(h / kStep)));
  const Motors from = motors;
  std::array<double, kMaxRotors> sum{};
  for (int s = 0; s < steps; ++s) {
    const Motors before = motors;
    flight.advance(motors, t + s * h / steps, h / steps);
    for (std::size_t n = 0; n < rotors; ++n)
      sum[n] += 0.5 * (before[n].Omega * before[n].Omega + motors[n].Omega * motors[n].Omega);
  }
  Motors between{};
  for (std::size_t n = 0; n < rotors; ++n)
    between[n] = {std::sqrt(sum[n] / steps), (motors[n].Omega - from[n].Omega) / h};
  return between;
}

MotorsAlong motors_along(const MeasuredArc& measured, Model& flight, std::size_t rotors) {
  const FlightArc& arc = *measured.arc;
  const std::vector<double>& t = measured.t;
  const bool commanded = arc.inputs->commanded();
  MotorsAlong out{.at = std::vector<Motors>(t.size()), .between = std::vector<Motors>(t.size())};
  Motors motors{};
  if (commanded)
    motors = motors_at_start(flight, t[0], rotors);
  else
    flight.advance(motors, t[0], 0.0);
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (std::size_t n = 0; n < rotors && commanded; ++n) {
      const double y = arc.y[measured.row[i] * kChannels + kRotorChannel + n];
      if (std::isfinite(y) && y > 0) motors[n].Omega += kBelieved * (y - motors[n].Omega);
    }
    out.at[i] = motors;
    if (i + 1 < t.size()) out.between[i] = advanced(flight, motors, t[i], t[i + 1] - t[i], rotors);
  }
  return out;
}

// Half way between two states.
BodyState<double> half_way(const BodyState<double>& a, const BodyState<double>& b) {
  const double side = a.q_WB.dot(b.q_WB) < 0 ? -1.0 : 1.0;
  BodyState<double> mid;
  mid.q_WB = (a.q_WB + side * b.q_WB).normalized();
  mid.w_B = 0.5 * (a.w_B + b.w_B), mid.v_W = 0.5 * (a.v_W + b.v_W), mid.x_W = 0.5 * (a.x_W + b.x_W);
  return mid;
}

ModelAlong along(const MeasuredArc& measured, const Vehicle& vehicle, std::span<const double> p,
                 std::shared_ptr<const MotorsAlong> motors) {
  const EffectSet<double> effects(p, active_effects(p));
  Model flight(vehicle, p, effects, *measured.arc->inputs);
  const std::size_t rotors = vehicle.rotors.size();
  if (!motors) motors = std::make_shared<const MotorsAlong>(motors_along(measured, flight, rotors));
  ModelAlong out;
  out.motors = std::move(motors);
  const std::vector<double>& t = measured.t;
  out.gained_W.assign(t.size(), Vec3<double>::Zero());
  out.turned_B = out.gained_W;
  const Vec3<double>& c = flight.body().centre_of_gravity();
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const BodyState<double> body = half_way(measured.body[i], measured.body[i + 1]);
    BodyRate<double> rate = flight.body().rate(body, std::span(out.motors->between[i].data(), rotors));
    // Of the centre of gravity: forces are not to suffer from moments that inputs do not explain.
    const Vec3<double>& w = body.w_B;
    rate.v_dot_W +=
        rotation(body.q_WB) * Vec3<double>(cross(rate.w_dot_B, c) + cross(w, Vec3<double>(cross(w, c))));
    rate.v_dot_W[2] -= vehicle.g;
    out.gained_W[i + 1] = out.gained_W[i] + (t[i + 1] - t[i]) * rate.v_dot_W;
    out.turned_B[i + 1] = out.turned_B[i] + (t[i + 1] - t[i]) * rate.w_dot_B;
  }
  return out;
}

}  // namespace

std::vector<ModelAlong> model_along(const MeasuredMotion& motion, std::span<const double> p) {
  const Stage stage("plain model along the motion");
  std::vector<ModelAlong> all;
  for (const MeasuredArc& arc : motion.arcs) all.push_back(along(arc, *motion.record->vehicle, p, nullptr));
  return all;
}

std::vector<ModelAlong> model_along(const MeasuredMotion& motion, std::span<const double> p,
                                    const std::vector<ModelAlong>& near, int moved) {
  if (all_parameters()[static_cast<std::size_t>(moved)].drives) return model_along(motion, p);
  const Stage stage("plain model along the motion");
  std::vector<ModelAlong> all;
  for (std::size_t a = 0; a < motion.arcs.size(); ++a)
    all.push_back(along(motion.arcs[a], *motion.record->vehicle, p, near[a].motors));
  return all;
}

}  // namespace ident
