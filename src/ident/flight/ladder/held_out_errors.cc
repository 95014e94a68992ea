// Predicts each window four ways: forces along measured flight, moments along measured velocity, everything,
// and rotors by their commands.
#include "ident/flight/ladder/held_out_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ident/core/parallel.h"
#include "ident/core/stage_times.h"
#include "ident/flight/ladder/model_along.h"
#include "ident/flight/ladder/speeds_along.h"
#include "ident/result/result.h"

namespace ident {
namespace {

using Effects = EffectSet<double>;
using Vehicles = Flight<double, Effects>;
using Motors = MotorsAlong::Motors;

constexpr double kSpacing = 0.5;     // s between windows
constexpr double kTumbling = 200.0;  // rad/s: no vehicle turns faster, and no prediction is worse than that

std::size_t at(Metric metric) { return static_cast<std::size_t>(metric); }

double angle_between(const Vec4<double>& a, const Vec4<double>& b) {
  const double c = std::abs(a.dot(b)) / std::max(a.norm() * b.norm(), 1e-12);
  const double angle = 2 * std::acos(std::min(c, 1.0));
  return std::isfinite(angle) ? angle : std::numbers::pi;
}

double size_of(const Vec3<double>& error, double most) {
  const double size = error.norm();
  return std::isfinite(size) ? std::min(size, most) : most;
}

// The rows at which the horizons of a window end; those that the arc does not reach are its first row.
std::array<std::size_t, kLadderHorizons.size()> ends_of(const MeasuredArc& measured, std::size_t begin,
                                                        double early) {
  std::array<std::size_t, kLadderHorizons.size()> ends;
  const std::vector<double>& t = measured.t;
  for (std::size_t h = 0; h < ends.size(); ++h) {
    const auto row = std::lower_bound(t.begin(), t.end(), t[begin] + kLadderHorizons[h] - early) - t.begin();
    ends[h] = static_cast<std::size_t>(row) < t.size() ? static_cast<std::size_t>(row) : begin;
  }
  return ends;
}

BodyState<double> turned(BodyState<double> body, const BodyRate<double>& rate, double h) {
  body.q_WB = (body.q_WB + h * rate.q_dot).normalized();
  body.w_B += h * rate.w_dot_B;
  return body;
}

// One step of the midpoint rule in attitude and rates; velocity and position are those measured.
BodyState<double> turned_on(const Body<double, Effects>& model, const BodyState<double>& from,
                            const BodyState<double>& measured, std::span<const MotorState<double>> motors,
                            double h) {
  BodyState<double> middle = turned(from, model.rate(from, motors), h / 2);
  middle.v_W = 0.5 * (from.v_W + measured.v_W), middle.x_W = 0.5 * (from.x_W + measured.x_W);
  BodyState<double> to = turned(from, model.rate(middle, motors), h);
  to.v_W = measured.v_W, to.x_W = measured.x_W;
  return to;
}

struct Prediction {
  const MeasuredMotion& motion;
  std::span<const double> p;
  std::vector<ModelAlong> along;
  Effects effects;
  std::vector<std::vector<RotorSpeeds>> measured;
};

void predict_turning(WindowErrors& errors, const Prediction& by, const Vehicles& flight, std::size_t begin,
                     std::span<const std::size_t> ends) {
  const MeasuredArc& measured = by.motion.arcs[errors.arc];
  const std::vector<double>& t = measured.t;
  const std::size_t rotors = by.motion.record->vehicle->rotors.size();
  BodyState<double> body = measured.body[begin];
  const std::size_t last = *std::ranges::max_element(ends);
  for (std::size_t i = begin; i < last; ++i) {
    const MotorsAlong& motors = *by.along[errors.arc].motors;
    if (body.w_B.norm() < kTumbling)
      body = turned_on(flight.body(), body, measured.body[i + 1], std::span(motors.between[i].data(), rotors),
                       t[i + 1] - t[i]);
    for (std::size_t h = 0; h < ends.size(); ++h) {
      if (ends[h] != i + 1) continue;
      errors.of[at(Metric::rate)][h] = size_of(body.w_B - measured.body[i + 1].w_B, kTumbling);
      errors.of[at(Metric::attitude)][h] = angle_between(body.q_WB, measured.body[i + 1].q_WB);
    }
  }
}

void predict_all(WindowErrors& errors, const Prediction& by, Vehicles& flight, std::size_t begin,
                 std::span<const std::size_t> ends) {
  const MeasuredArc& measured = by.motion.arcs[errors.arc];
  const std::vector<double>& t = measured.t;
  FlightState<double> state{};
  state.body = measured.body[begin], state.motors = by.along[errors.arc].motors->at[begin];
  BodyRate<double> rate = flight.rate(state, t[begin]);
  const std::size_t last = *std::ranges::max_element(ends);
  for (std::size_t i = begin; i < last; ++i) {
    const int steps = std::max(1, static_cast<int>(std::ceil((t[i + 1] - t[i]) / kLongStep)));
    const double h = (t[i + 1] - t[i]) / steps;
    for (int s = 0; s < steps && state.body.w_B.norm() < kTumbling; ++s) {
      flight.step_on(state, t[i] + s * h, h, rate);
      state.body.q_WB.normalize();
    }
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (ends[k] != i + 1) continue;
      errors.of[at(Metric::open_velocity)][k] = size_of(state.body.v_W - measured.body[i + 1].v_W, kTumbling);
      errors.of[at(Metric::open_attitude)][k] = angle_between(state.body.q_WB, measured.body[i + 1].q_WB);
    }
  }
}

// Root mean square of what rotors differ by; NaN where none was measured.
double apart(const RotorSpeeds& measured, const Motors& model, std::size_t rotors) {
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < rotors; ++n)
    if (const double d = measured[n] - model[n].Omega; std::isfinite(d)) sum += d * d, count += 1;
  return count > 0 ? std::sqrt(sum / count) : kNaN;
}

void predict_speeds(WindowErrors& errors, const Prediction& by, Vehicles& flight, std::size_t begin,
                    std::span<const std::size_t> ends) {
  const std::vector<double>& t = by.motion.arcs[errors.arc].t;
  Motors motors = by.along[errors.arc].motors->at[begin];
  const std::size_t last = *std::ranges::max_element(ends);
  for (std::size_t i = begin; i < last; ++i) {
    flight.advance(motors, t[i], t[i + 1] - t[i]);
    for (std::size_t h = 0; h < ends.size(); ++h)
      if (ends[h] == i + 1)
        errors.of[at(Metric::rotor_speed)][h] =
            apart(by.measured[errors.arc][i + 1], motors, by.motion.record->vehicle->rotors.size());
  }
}

// Windows with all errors NaN, and the row at which each begins.
std::vector<std::pair<WindowErrors, std::size_t>> empty_windows(const MeasuredMotion& motion) {
  std::vector<std::pair<WindowErrors, std::size_t>> all;
  for (const Window& w : windows_of(motion, kLadderHorizons.front(), kSpacing)) {
    WindowErrors errors{.arc = w.arc, .t = w.t};
    for (auto& metric : errors.of) metric.fill(kNaN);
    all.emplace_back(errors, w.begin);
  }
  return all;
}

}  // namespace

std::vector<WindowErrors> held_out_errors(const MeasuredMotion& motion, std::span<const double> p) {
  const Stage stage("held-out errors of plain models");
  auto windows = empty_windows(motion);
  const Prediction by{motion, p, model_along(motion, p), Effects(p, active_effects(p)),
                      motion.speeds ? measured_speeds(motion) : std::vector<std::vector<RotorSpeeds>>{}};
  in_parallel(windows.size(), [&](std::size_t w) {
    auto& [errors, begin] = windows[w];
    const MeasuredArc& measured = motion.arcs[errors.arc];
    const auto ends = ends_of(measured, begin, 0.5 * typical_row(motion));
    const ModelAlong& model = by.along[errors.arc];
    for (std::size_t h = 0; h < ends.size() && motion.forces; ++h)
      if (ends[h] > begin)
        errors.of[at(Metric::velocity)][h] = size_of(measured.gained_W[ends[h]] - measured.gained_W[begin] -
                                                         (model.gained_W[ends[h]] - model.gained_W[begin]),
                                                     kTumbling);
    Vehicles flight(*motion.record->vehicle, p, by.effects, *measured.arc->inputs);
    flight.step_to_order(2);
    if (motion.moments) predict_turning(errors, by, flight, begin, ends);
    if (motion.velocity && motion.moments) predict_all(errors, by, flight, begin, ends);
    if (motion.speeds) predict_speeds(errors, by, flight, begin, ends);
  });
  std::vector<WindowErrors> out;
  for (const auto& [errors, begin] : windows) out.push_back(errors);
  return out;
}

std::vector<WindowErrors> errors_of_persistence(const MeasuredMotion& motion) {
  std::vector<WindowErrors> out;
  std::vector<std::vector<RotorSpeeds>> speeds;
  if (motion.speeds) speeds = measured_speeds(motion);
  for (auto& [errors, begin] : empty_windows(motion)) {
    const MeasuredArc& measured = motion.arcs[errors.arc];
    const auto ends = ends_of(measured, begin, 0.5 * typical_row(motion));
    for (std::size_t h = 0; h < ends.size(); ++h) {
      if (ends[h] <= begin) continue;
      const double T = measured.t[ends[h]] - measured.t[begin];
      const BodyState<double>&from = measured.body[begin], &to = measured.body[ends[h]];
      Vec4<double> turn(1.0, T / 2 * from.w_B[0], T / 2 * from.w_B[1], T / 2 * from.w_B[2]);
      const double half = turn.tail<3>().norm();
      if (half > 1e-9) turn.tail<3>() *= std::sin(half) / half, turn[0] = std::cos(half);
      const double attitude = angle_between(quaternion_product(from.q_WB, turn), to.q_WB);
      if (motion.forces) {
        Vec3<double> gained = measured.gained_W[ends[h]] - measured.gained_W[begin];
        if (motion.velocity) gained[2] += motion.record->vehicle->g * T;
        errors.of[at(Metric::velocity)][h] = gained.norm();
      }
      if (motion.moments) {
        errors.of[at(Metric::rate)][h] = (to.w_B - from.w_B).norm();
        errors.of[at(Metric::attitude)][h] = attitude;
      }
      if (motion.speeds) {
        Motors held{};
        for (std::size_t n = 0; n < kMaxRotors; ++n) held[n].Omega = speeds[errors.arc][begin][n];
        errors.of[at(Metric::rotor_speed)][h] =
            apart(speeds[errors.arc][ends[h]], held, motion.record->vehicle->rotors.size());
      }
      if (motion.velocity && motion.moments) {
        errors.of[at(Metric::open_velocity)][h] = errors.of[at(Metric::velocity)][h];
        errors.of[at(Metric::open_attitude)][h] = attitude;
      }
    }
    out.push_back(errors);
  }
  return out;
}

double error_of(const std::vector<WindowErrors>& windows, Metric metric, std::size_t horizon) {
  double sum = 0, n = 0;
  for (const WindowErrors& w : windows)
    if (const double e = w.of[at(metric)][horizon]; std::isfinite(e)) sum += e * e, n += 1;
  return n > 0 ? std::sqrt(sum / n) : kNaN;
}

}  // namespace ident
