// The vehicle's model, evaluated at every row of measured flight and summed up by the trapezium rule.
#include "ident/flight/ladder/model_along.h"

#include <cmath>

#include "ident/core/stage_times.h"

namespace ident {
namespace {

constexpr double kBelieved = 0.5;  // share of the difference to a measured speed that a motor takes over

ModelAlong along(const MeasuredArc& measured, const Vehicle& vehicle, std::span<const double> p) {
  const FlightArc& arc = *measured.arc;
  const EffectSet<double> effects(p, active_effects(p));
  Flight<double, EffectSet<double>> flight(vehicle, p, effects, *arc.inputs);
  const std::size_t rotors = vehicle.rotors.size();
  ModelAlong out;
  const std::vector<double>& t = measured.t;
  out.gained_W.assign(t.size(), Vec3<double>::Zero());
  out.turned_B = out.gained_W;
  out.motors.resize(t.size());
  FlightState<double> state{};
  if (arc.inputs->commanded())
    for (std::size_t n = 0; n < rotors; ++n) state.motors[n] = {flight.steady_speed(n, t[0]), 0.0};
  BodyRate<double> before;
  for (std::size_t i = 0; i < t.size(); ++i) {
    state.body = measured.body[i];
    for (std::size_t n = 0; n < rotors && arc.inputs->commanded(); ++n) {
      const double y = arc.y[measured.row[i] * kChannels + kRotorChannel + n];
      if (std::isfinite(y) && y > 0) state.motors[n].Omega += kBelieved * (y - state.motors[n].Omega);
    }
    BodyRate<double> now = flight.rate(state, t[i]);
    // Of the centre of gravity: forces are not to suffer from moments that inputs do not explain.
    const Vec3<double>&w = state.body.w_B, &c = flight.body().centre_of_gravity();
    now.v_dot_W +=
        rotation(state.body.q_WB) * Vec3<double>(cross(now.w_dot_B, c) + cross(w, Vec3<double>(cross(w, c))));
    out.motors[i] = state.motors;
    if (i > 0) {
      const double half = 0.5 * (t[i] - t[i - 1]);
      Vec3<double> f = before.v_dot_W + now.v_dot_W;
      f[2] -= 2 * vehicle.g;
      out.gained_W[i] = out.gained_W[i - 1] + half * f;
      out.turned_B[i] = out.turned_B[i - 1] + half * (before.w_dot_B + now.w_dot_B);
    }
    before = now;
    if (i + 1 < t.size() && arc.inputs->commanded()) flight.advance(state.motors, t[i], t[i + 1] - t[i]);
  }
  return out;
}

}  // namespace

std::vector<ModelAlong> model_along(const MeasuredMotion& motion, std::span<const double> p) {
  const Stage stage("plain model along the motion");
  std::vector<ModelAlong> all;
  for (const MeasuredArc& arc : motion.arcs) all.push_back(along(arc, *motion.record->vehicle, p));
  return all;
}

}  // namespace ident
