// What a known loop leaves open of the motors.
#include "ident/flight/fit/loop_timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ident/effects/catalogue.h"
#include "support/known_quad.h"

namespace ident {
namespace {

FlightLog with_loop(double loop, double apart) {
  FlightLog log;
  log.loop = loop, log.each_command = loop > 0;
  for (int i = 0; i < 50; ++i) log.t.push_back(apart * i), log.w_B[0].push_back(0.0);
  return log;
}

// The answer of a motor has the mean lag 2 zeta/omega and the variance (4 zeta^2 - 2)/omega^2.
TEST(LoopTiming, SamplesThatAreMeansWidenTheAnswerAtTheSameLag) {
  const Vehicle vehicle = testing::known(testing::quad());
  const std::vector<double> p = parameter_vector(vehicle);
  const Theta theta(p, free_constants(vehicle, p), 1, true);
  FlightFit fit;
  fit.u = Eigen::VectorXd::Zero(theta.size());
  const double T = 0.002;
  const std::vector<FlightLog> logs{with_loop(0.0025, T)};
  const std::vector<double> moved = theta.p(moved_by_smoothing(logs, theta, fit));
  const auto lag = [](const std::vector<double>& q) { return 2 * q[param::zeta_m] / q[param::omega_m]; };
  const auto variance = [](const std::vector<double>& q) {
    return (4 * q[param::zeta_m] * q[param::zeta_m] - 2) / (q[param::omega_m] * q[param::omega_m]);
  };
  EXPECT_NEAR(lag(moved), lag(p), 1e-9 * lag(p));
  EXPECT_NEAR(std::abs(variance(moved) - variance(p)), T * T / 12, 1e-2 * T * T / 12);
  EXPECT_TRUE(moved_by_smoothing(std::vector<FlightLog>{with_loop(0, T)}, theta, fit).isZero());
}

TEST(LoopTiming, TheDeadTimeIsOpenToALoop) {
  const Vehicle vehicle = testing::known(testing::quad());
  const std::vector<double> p = parameter_vector(vehicle);
  const std::vector<FreeConstant> before = free_constants(vehicle, p);
  std::vector<FreeConstant> constants = before;
  leave_loop_open(constants, vehicle, p, std::vector<FlightLog>{with_loop(0, 0.002)});
  EXPECT_EQ(constants.size(), before.size());
  leave_loop_open(constants, vehicle, p,
                  std::vector<FlightLog>{with_loop(0.0025, 0.002), with_loop(0.002, 0.002)});
  const auto at = std::ranges::find(constants, "dead_time", &FreeConstant::name);
  ASSERT_NE(at, constants.end());
  const auto was = std::ranges::find(before, "dead_time", &FreeConstant::name);
  const double known = was != before.end() && was->prior_std ? *was->prior_std : 0.0;
  EXPECT_NEAR(at->prior_std.value_or(0.0), std::hypot(known, 0.0025), 1e-12);
}

}  // namespace
}  // namespace ident
