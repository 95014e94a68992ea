// Slopes of a chunk's start and of all constants, with every effect, against central differences.
#include <gtest/gtest.h>

#include <utility>

#include "ident/effects/all_parameters.h"
#include "support/open_loop_flight.h"

namespace ident {
namespace {

// The state moved by d in one local direction; an attitude turns about the body's axis k.
FlightState<double> moved(FlightState<double> x, const StateLayout& layout, int i, double d) {
  const auto within = [&](int at, int size) { return at >= 0 && i >= at && i < at + size; };
  if (within(layout.w, 3)) x.body.w_B[i - layout.w] += d;
  if (within(layout.v, 3)) x.body.v_W[i - layout.v] += d;
  if (within(layout.x, 3)) x.body.x_W[i - layout.x] += d;
  if (within(layout.w_dot, 3)) x.outside.w_dot_B[i - layout.w_dot] += d;
  if (within(layout.v_dot, 3)) x.outside.v_dot[i - layout.v_dot] += d;
  for (std::size_t g = 0; g < kShownGroups; ++g)
    if (within(layout.shown_error[g], 3)) x.shown_error[g][i - layout.shown_error[g]] += d;
  if (within(layout.motors, 2 * layout.rotors)) {
    const int n = i - layout.motors;
    auto& motor = x.motors[static_cast<std::size_t>(n % layout.rotors)];
    (n < layout.rotors ? motor.Omega : motor.Omega_dot) += d;
  }
  if (within(layout.attitude, 3)) {
    Vec4<double> turn(std::cos(d / 2), 0, 0, 0);
    turn[1 + i - layout.attitude] = std::sin(d / 2);
    x.body.q_WB = quaternion_product(x.body.q_WB, turn);
  }
  return x;
}

// Where b stands seen from a, in the local directions.
Eigen::VectorXd apart(const FlightState<double>& a, const FlightState<double>& b, const StateLayout& layout) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(layout.size);
  const auto put = [&](int at, const Vec3<double>& v) {
    if (at >= 0) d.segment<3>(at) = v;
  };
  put(layout.w, b.body.w_B - a.body.w_B);
  put(layout.v, b.body.v_W - a.body.v_W);
  put(layout.x, b.body.x_W - a.body.x_W);
  put(layout.w_dot, b.outside.w_dot_B - a.outside.w_dot_B);
  put(layout.v_dot, b.outside.v_dot - a.outside.v_dot);
  for (std::size_t g = 0; g < kShownGroups; ++g)
    put(layout.shown_error[g], b.shown_error[g] - a.shown_error[g]);
  const Vec4<double>& q = a.body.q_WB;
  put(layout.attitude,
      2 * quaternion_product(Vec4<double>(q[0], -q[1], -q[2], -q[3]), b.body.q_WB).tail<3>());
  for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n) {
    const auto m = static_cast<std::size_t>(n);
    d[layout.motors + n] = b.motors[m].Omega - a.motors[m].Omega;
    d[layout.motors + layout.rotors + n] = b.motors[m].Omega_dot - a.motors[m].Omega_dot;
  }
  return d;
}

// Every direction of the start: what it does to the cost and to the end, against central differences.
void expect_true_slopes(ChunkTask task) {
  task.exact = true;
  task.x0.body.q_WB = Vec4<double>(0.9, 0.2, -0.3, 0.25).normalized();  // no axis is like another
  const FlightState<double> start = task.x0;
  const StateLayout& layout = task.layout;
  ASSERT_GE(layout.attitude, 0);
  ASSERT_GE(layout.motors, 0);
  ASSERT_GE(layout.v_dot, 0);
  ChunkResult exact, up, down;
  ASSERT_TRUE(evaluate_chunk_with("baseline", task, exact));
  const int columns = layout.size + task.thetas;
  for (int i = 0; i < layout.size; ++i) {
    const double h = 1e-5;
    task.x0 = moved(start, layout, i, h);
    evaluate_chunk_with("baseline", task, up);
    task.x0 = moved(start, layout, i, -h);
    evaluate_chunk_with("baseline", task, down);
    const double numeric = (up.cost - down.cost) / (2 * h),
                 analytic = 2 * exact.g[static_cast<std::size_t>(i)];
    EXPECT_NEAR(analytic, numeric, 1e-5 * std::abs(numeric) + 1e-3) << "cost, direction " << i;
    const Eigen::VectorXd end =
        (apart(exact.x_end, up.x_end, layout) - apart(exact.x_end, down.x_end, layout)) / (2 * h);
    for (int k = 0; k < layout.size; ++k)
      EXPECT_NEAR(exact.E[static_cast<std::size_t>(k * columns + i)], end[k], 1e-5 * (1 + end.norm()))
          << "end " << k << ", direction " << i;
  }
}

TEST(FlightKernel, SlopesOfTheStartAreThoseOfCostAndEnd) {
  Setting s;
  std::vector<double> constants;
  expect_true_slopes(s.task(Eigen::VectorXd::Constant(s.theta.size(), 0.02), constants));
}

TEST(FlightKernel, SlopesOfTheStartHoldWithAPushThatTurnsWithTheBody) {
  Setting s;
  std::vector<double> constants;
  ChunkTask task = s.task(Eigen::VectorXd::Constant(s.theta.size(), 0.02), constants);
  task.x0.body.w_B = {1.0, -2.0, 1.5};
  task.x0.outside.v_dot = {0.5, -0.3, 0.8};
  task.x0.outside.axes = GustAxes::body;
  expect_true_slopes(task);
}

TEST(FlightKernel, SlopesOfTheStartHoldWithSlowErrors) {
  Setting s;
  for (int& at : s.record.layout.shown_error)
    at = std::exchange(s.record.layout.size, s.record.layout.size + 3);
  std::vector<double> constants;
  ChunkTask task = s.task(Eigen::VectorXd::Constant(s.theta.size(), 0.02), constants);
  task.x0.shown_error[kShownAttitude] = {0.05, -0.1, 0.08};
  task.x0.shown_error[kShownVelocity] = {-0.2, 0.1, 0.3};
  task.x0.shown_error[kShownPosition] = {0.1, 0.4, -0.2};
  for (const double shift : {0.0, 0.0153}) {
    task.shift = shift;
    expect_true_slopes(task);
  }
}

// Which columns need no dual numbers goes with what the effects touch.
TEST(FlightKernel, SlopesOfTheStartHoldWithEveryEffect) {
  Setting s;
  std::vector<double> constants;
  ChunkTask task = s.task(Eigen::VectorXd::Constant(s.theta.size(), 0.02), constants);
  const std::vector<double> plain = constants;
  for (const EffectEntry& e : catalogue()) {
    SCOPED_TRACE(e.info.name);
    constants = plain;
    constants[static_cast<std::size_t>(find_parameter("rotor_drag.kd")->index)] =
        e.id == EffectId::wind ? 2e-5 : 0.0;  // wind acts through drag
    for (std::size_t i = 0; i < e.parameters.size(); ++i)
      constants[static_cast<std::size_t>(e.offset) + i] += e.parameters[i].typical;
    task.p = constants;
    task.active = active_effects(constants);
    expect_true_slopes(task);
  }
}

// With each effect in turn: its own constants, and those that it makes something of.
TEST(FlightKernel, SlopesOfTheConstantsHoldWithEveryEffect) {
  Setting s;
  for (const EffectEntry& e : catalogue()) {
    SCOPED_TRACE(e.info.name);
    std::vector<double> p = s.p, constants;
    p[static_cast<std::size_t>(find_parameter("rotor_drag.kd")->index)] = 2e-5;
    std::vector<std::string> own;
    for (const ParameterInfo& info : all_parameters()) {
      const int i = info.index - e.offset;
      if (i < 0 || i >= static_cast<int>(e.parameters.size())) continue;
      own.push_back(info.name);
      p[static_cast<std::size_t>(info.index)] += 2 * e.parameters[static_cast<std::size_t>(i)].typical;
    }
    s.theta = Theta(p, free_constants(s.vehicle, p, own), 1, true);
    const Eigen::VectorXd u = Eigen::VectorXd::Constant(s.theta.size(), 0.02);
    const auto evaluated = [&](const Eigen::VectorXd& at) {
      ChunkTask task = s.task(at, constants);
      task.exact = true, task.huber = 1e9;
      task.active = active_effects(constants);
      ChunkResult r;
      evaluate_chunk(task, r);
      return r;
    };
    const ChunkResult here = evaluated(u);
    for (int i = 0; i < s.theta.size(); ++i) {
      const Eigen::VectorXd step = 1e-4 * Eigen::VectorXd::Unit(s.theta.size(), i);
      const double numeric = (evaluated(u + step).cost - evaluated(u - step).cost) / 2e-4,
                   analytic = 2 * here.g[static_cast<std::size_t>(s.record.layout.size + i)];
      EXPECT_NEAR(analytic, numeric, 1e-3 * std::abs(numeric) + 1e-6 * here.cost) << s.theta.name(i);
    }
  }
}

}  // namespace
}  // namespace ident
