// Bursts: found where accelerations from outside jump, not in steady gusts.
#include "ident/gap/statistics/bursts.h"

#include <gtest/gtest.h>

#include "ident/core/random.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/make_record.h"
#include "support/published_hover.h"

namespace ident {
namespace {

// A fit whose smoothed accelerations are steady gusts, with a burst of `burst` m/s^2 downwards over two
// pieces.
std::vector<Burst> found_with(double burst, double* at = nullptr, bool hole = false) {
  const Vehicle vehicle = testing::published_vehicle();
  FlightRecord record = testing::hover_record(vehicle, vehicle, 20.0);
  const std::vector<double> p = parameter_vector(vehicle);
  const Theta theta(p, {}, 1, true);
  FlightFit fit;
  fit.noise = initial_noise(record);
  fit.smoother = std::make_shared<FlightSmoother>(record, theta, fit.noise, 0.1);
  if (hole) {  // rows are missing in piece 90
    std::vector<double>& t = record.arcs[0].t;
    for (std::size_t i = fit.smoother->chunks()[90].begin + 3; i < t.size(); ++i) t[i] += 0.02;
  }
  std::vector<FlightState<double>> states = fit.smoother->states();
  if (at) *at = record.arcs[0].t[fit.smoother->chunks()[90].begin];
  Random random(7);
  double gust = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    gust = 0.9 * gust + random.normal();
    states[k].outside.v_dot = {0.0, 0.0, gust + (k == 90 || k == 91 ? burst : 0.0)};
  }
  fit.smoother->set_states(states);
  return bursts(record, fit);
}

TEST(Bursts, SteadyGustsAreNone) { EXPECT_TRUE(found_with(0.0).empty()); }

TEST(Bursts, AJumpToAndFroIsNamedWithItsChannelAndTime) {
  double at = 0;
  const std::vector<Burst> found = found_with(20.0, &at);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].channel, "Fz");
  EXPECT_EQ(found[0].count, 2);
  EXPECT_NEAR(found[0].t, at, 0.3);  // its onset or its end
}

// Commands of rows that are missing are not known either.
TEST(Bursts, WhatMotorsDidWhereRowsAreMissingIsNone) {
  EXPECT_EQ(found_with(20.0).size(), 1u);
  EXPECT_TRUE(found_with(20.0, nullptr, true).empty());
}

// Pushed `times` what gusts and the error of measured speeds make of a jump along one axis, which are the
// input; all else is calm.
int plain_jumps(int axis, double times) {
  const Vehicle vehicle = testing::published_vehicle();
  SimulationOptions options;
  options.scenario = "hover", options.duration = 20.0, options.rate = 100.0;
  std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  logs[0].delta.clear();
  Random random(7);
  for (auto& column : logs[0].Omega)
    for (double& Omega : column) Omega += random.normal();
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, {}, 1, true);
  FlightFit fit;
  fit.noise = initial_noise(record);
  fit.smoother = std::make_shared<FlightSmoother>(record, theta, fit.noise, 0.1);
  const ColouredNoise& gusts = axis < 3 ? fit.noise.air[0].w_dot[0] : fit.noise.air[0].v_dot[0];
  const double made = std::sqrt(2 * gusts.sigma * gusts.sigma * (1 - gusts.carried(0.1)) +
                                2 * fit.smoother->input_error(90, axis));
  std::vector<FlightState<double>> states = fit.smoother->states();
  for (std::size_t k = 0; k < states.size(); ++k) {
    Disturbance<double>& outside = states[k].outside;
    outside.w_dot_B.setZero(), outside.v_dot.setZero();
    double& one = axis < 3 ? outside.w_dot_B[axis] : outside.v_dot[axis - 3];
    one = 0.01 * made * random.normal() + (k == 90 || k == 91 ? times * made : 0.0);
  }
  fit.smoother->set_states(states);
  const std::vector<Burst> found = bursts(record, fit);
  EXPECT_FALSE(found.empty());
  return found.empty() ? -1 : found[0].plain;
}

TEST(Bursts, WhatASuddenDriveBetweenSamplesOfTheSpeedsMakesIsNotPlain) {
  EXPECT_EQ(plain_jumps(0, 6.0), 0) << "a moment";
  EXPECT_EQ(plain_jumps(0, 12.0), 2);
  EXPECT_EQ(plain_jumps(5, 6.0), 2) << "a force, which no drive makes so";
}

}  // namespace
}  // namespace ident
