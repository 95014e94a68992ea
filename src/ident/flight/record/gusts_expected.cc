// The answer of the hovering model to a gust, or that of a usual drag.
#include "ident/flight/record/gusts_expected.h"

#include <cmath>

namespace ident {
namespace {

// Drag of small multirotors per mass, 1/s: 0.2 to 0.5 across the rotors (sim/turbulence.h), of thrust that
// falls with the climb 0.4 to 0.7.
constexpr double kUsualAcross = 0.3, kUsualAlong = 0.5;
// Factors of one standard deviation. The level is a word for speeds that double from one to the next, and a
// drag that nobody stated varies by 1.6.
constexpr double kOfStatedDrag = 2.0, kOfUsualDrag = 2.5;
constexpr double kFarFromGround = 10.0;  // m
constexpr double kSomeDrag = 1e-3;       // 1/s: less is none

using Axes = std::array<double, 3>;

// Change of acceleration by a gust along each axis, as the stated model has it, (26).
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

// Arm of gusts that differ between the two halves of the rotors, m, (27).
double arm_of_gradient(double mean_square, double length) {
  const double y = std::sqrt(mean_square);
  return 0.5 * y * std::sqrt(2 * (1 - std::exp(-2 * y / length)));
}

}  // namespace

GustsExpected gusts_expected(const FlightRecord& record) {
  const Vehicle& vehicle = *record.vehicle;
  GustsExpected out{
      .level = vehicle.air.value_or(kUnstatedAir), .stated = vehicle.air.has_value(), .prior = {}};
  const GustScale gusts = gusts_of(out.level);
  const Axes speed{gusts.horizontal, gusts.horizontal, gusts.vertical};
  const Axes usual{kUsualAcross, kUsualAcross, kUsualAlong};
  const Axes by_model = answer_of_model(record, speed);
  const double m = record.p[param::m];
  bool all_stated = true;
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool drags = by_model[i] > kSomeDrag * speed[i];
    all_stated = all_stated && drags;
    out.prior.v_dot[i] = drags ? by_model[i] : usual[i] * speed[i];
    square += out.prior.v_dot[i] * out.prior.v_dot[i];
  }
  out.prior.log_std = std::log(all_stated ? kOfStatedDrag : kOfUsualDrag);
  out.force = m * std::sqrt(square);
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();
  for (const Rotor& rotor : vehicle.rotors)
    spread += rotor.r_B.cwiseAbs2() / static_cast<double>(vehicle.rotors.size());
  const auto& push = out.prior.v_dot;
  const Axes moment{m * push[2] * arm_of_gradient(spread.y(), gusts.length),
                    m * push[2] * arm_of_gradient(spread.x(), gusts.length),
                    m * push[0] * arm_of_gradient(spread.x() + spread.y(), gusts.length)};
  out.prior.w_dot = {moment[0] / record.p[param::Jxx], moment[1] / record.p[param::Jyy],
                     moment[2] / record.p[param::Jzz]};
  return out;
}

}  // namespace ident
