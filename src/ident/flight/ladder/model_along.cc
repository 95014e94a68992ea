// The vehicle's model, evaluated at every row of measured flight and summed up by the trapezium rule.
#include "ident/flight/ladder/model_along.h"

#include <cmath>

#include "ident/core/stage_times.h"
#include "ident/effects/all_parameters.h"

namespace ident {
namespace {

constexpr double kBelieved = 0.5;  // share of the difference to a measured speed that a motor takes over

using Model = Flight<double, EffectSet<double>>;

MotorsAlong motors_along(const MeasuredArc& measured, Model& flight, std::size_t rotors) {
  const FlightArc& arc = *measured.arc;
  const std::vector<double>& t = measured.t;
  MotorsAlong out(t.size());
  if (!arc.inputs->commanded()) {
    FlightState<double> state{};
    for (std::size_t i = 0; i < t.size(); ++i) {
      flight.advance(state.motors, t[i], 0.0);
      out[i] = state.motors;
    }
    return out;
  }
  std::array<MotorState<double>, kMaxRotors> motors{};
  for (std::size_t n = 0; n < rotors; ++n) motors[n] = {flight.steady_speed(n, t[0]), 0.0};
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (std::size_t n = 0; n < rotors; ++n) {
      const double y = arc.y[measured.row[i] * kChannels + kRotorChannel + n];
      if (std::isfinite(y) && y > 0) motors[n].Omega += kBelieved * (y - motors[n].Omega);
    }
    out[i] = motors;
    if (i + 1 < t.size()) flight.advance(motors, t[i], t[i + 1] - t[i]);
  }
  return out;
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
  BodyRate<double> before;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const BodyState<double>& body = measured.body[i];
    BodyRate<double> now = flight.body().rate(body, std::span((*out.motors)[i].data(), rotors));
    // Of the centre of gravity: forces are not to suffer from moments that inputs do not explain.
    const Vec3<double>& w = body.w_B;
    now.v_dot_W +=
        rotation(body.q_WB) * Vec3<double>(cross(now.w_dot_B, c) + cross(w, Vec3<double>(cross(w, c))));
    if (i > 0) {
      const double half = 0.5 * (t[i] - t[i - 1]);
      Vec3<double> f = before.v_dot_W + now.v_dot_W;
      f[2] -= 2 * vehicle.g;
      out.gained_W[i] = out.gained_W[i - 1] + half * f;
      out.turned_B[i] = out.turned_B[i - 1] + half * (before.w_dot_B + now.w_dot_B);
    }
    before = now;
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
