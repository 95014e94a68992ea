// The answer of the hovering model to a gust, or that of a usual drag.
#include "ident/flight/checks/gusts_expected.h"

#include <cmath>

namespace ident {
namespace {

// Drag of small multirotors per mass, 1/s: 0.2 to 0.5 across the rotors (sim/turbulence.h), of thrust that
// falls with the climb 0.4 to 0.7.
constexpr std::array<double, 3> kUsual{0.3, 0.3, 0.5};
// Factors of one standard deviation. The level is a word for speeds that double from one to the next, and a
// drag that nobody stated varies by 1.6.
constexpr double kOfStatedDrag = 2.0, kOfUsualDrag = 2.5;
constexpr double kFarFromGround = 10.0;  // m
constexpr double kSomeDrag = 0.05;       // 1/s: less is what rotor drag does along a slanted axis, or none

using Axes = std::array<double, 3>;

// Change of acceleration by a gust along each axis, as the stated model has it, (31).
Axes answer_of_model(const FlightRecord& record, const Axes& gust) {
  const std::vector<double>& p = record.p;
  const EffectSet<double> effects(p, active_effects(p));
  const Body<double, EffectSet<double>> body(*record.vehicle, p, effects);
  const std::vector<MotorState<double>> motors(
      record.vehicle->rotors.size(),
      MotorState<double>{.Omega = 1.0 / body.per_Omega_hover(), .Omega_dot = 0});
  const auto acceleration = [&](int axis, double v) {
    BodyState<double> state{};
    state.q_WB = Vec4<double>(1.0, 0.0, 0.0, 0.0);
    state.v_W = state.w_B = state.x_W = Vec3<double>(0.0, 0.0, 0.0);
    state.x_W[2] = record.vehicle->ground_z - kFarFromGround;
    state.v_W[axis] = v;
    return body.rate(state, motors).v_dot_W[axis];
  };
  Axes answer{};
  for (int i = 0; i < 3; ++i) {
    const double v = gust[static_cast<std::size_t>(i)];
    answer[static_cast<std::size_t>(i)] = std::abs(acceleration(i, v) - acceleration(i, -v)) / 2;
  }
  return answer;
}

}  // namespace

GustsExpected gusts_expected(const FlightRecord& record) {
  const Vehicle& vehicle = *record.vehicle;
  const AirLevel level = vehicle.air.value_or(kUnstatedAir);
  const GustScale gusts = gusts_of(level);
  const Axes speed{gusts.horizontal, gusts.horizontal, gusts.vertical};
  const Axes by_model = answer_of_model(record, speed);
  bool all_stated = true;
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool drags = by_model[i] > kSomeDrag * speed[i];
    all_stated = all_stated && drags;
    const double v_dot = drags ? by_model[i] : kUsual[i] * speed[i];
    square += v_dot * v_dot;
  }
  return {.level = level,
          .stated = vehicle.air.has_value(),
          .force = record.p[param::m] * std::sqrt(square),  // (31)
          .log_std = std::log(all_stated ? kOfStatedDrag : kOfUsualDrag)};
}

}  // namespace ident
