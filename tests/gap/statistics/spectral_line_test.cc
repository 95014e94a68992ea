// Lines in what a fit leaves: of a motion, and of what only shows one.
#include "ident/gap/statistics/spectral_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/random.h"
#include "ident/flight/make_record.h"
#include "support/published_hover.h"

namespace ident {
namespace {

constexpr double kHz = 15.0;

std::vector<FlightLog> hover(double rate = 100.0) {
  SimulationOptions options;
  options.scenario = "hover", options.duration = 40.0, options.rate = rate;
  return {simulate_flight(testing::published_vehicle(), options).log};
}

std::vector<SpectralLine> lines_in(const std::vector<FlightLog>& logs) {
  static const Vehicle vehicle = testing::published_vehicle();
  const FlightRecord record = make_flight_record(vehicle, parameter_vector(vehicle), logs);
  const Theta theta(parameter_vector(vehicle), {}, 1, true);
  return spectral_lines(record, fit_flight(record, theta, {}));
}

// Lines after a hover in which the position sways by `sway` m at 15 Hz, and the specific force with it or
// not.
std::vector<SpectralLine> lines_of(double sway, bool felt) {
  std::vector<FlightLog> logs = hover();
  const double w = 2 * M_PI * kHz;
  for (std::size_t i = 0; i < logs[0].rows(); ++i) {
    const double s = sway * std::sin(w * logs[0].t[i]);
    logs[0].x_W[1][i] += s;
    if (felt) logs[0].f_B[1][i] -= w * w * s;
  }
  return lines_in(logs);
}

TEST(SpectralLines, AStillFlightHasNone) { EXPECT_TRUE(lines_of(0.0, false).empty()); }

TEST(SpectralLines, WhatSwaysIsNamedWithItsFrequency) {
  const auto lines = lines_of(3e-4, true);
  ASSERT_FALSE(lines.empty());
  EXPECT_NEAR(lines[0].hz, kHz, 0.3);
  EXPECT_TRUE(std::isnan(lines[0].rotor_hz));
}

// Eighty samples a second show the fifty turns of these rotors as thirty.
TEST(SpectralLines, WhatTheRotorsShakeIsToldByTheirTurns) {
  std::vector<FlightLog> logs = hover(80.0);
  const std::vector<double>& Omega = logs[0].Omega[0];
  double turns = 0, angle = 0;
  for (std::size_t i = 0; i < logs[0].rows(); ++i) {
    turns += Omega[i] / (2 * M_PI * static_cast<double>(logs[0].rows()));
    if (i > 0) angle += Omega[i] * (logs[0].t[i] - logs[0].t[i - 1]);
    logs[0].f_B[0][i] += 0.15 * std::sin(angle);
  }
  const auto lines = lines_in(logs);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].channel, "ax");
  EXPECT_NEAR(lines[0].rotor_hz, turns, 0.01 * turns);
  EXPECT_NEAR(lines[0].hz, 80 - turns, 1.0);
}

// A sway that the accelerometer would feel much more, and does not, is none.
TEST(SpectralLines, WhatOnlyAnEstimatorShowsIsNoMotion) { EXPECT_TRUE(lines_of(3e-3, false).empty()); }

}  // namespace
}  // namespace ident
