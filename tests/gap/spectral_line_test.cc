// Lines in what a fit leaves: of a motion, and of what only shows one.
#include "ident/gap/spectral_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/random.h"
#include "support/published_hover.h"

namespace ident {
namespace {

constexpr double kHz = 15.0;

// Lines after a hover in which the position sways by `sway` m at 15 Hz, and the specific force with it or
// not.
std::vector<SpectralLine> lines_of(double sway, bool felt) {
  static const Vehicle vehicle = testing::published_vehicle();
  SimulationOptions options;
  options.scenario = "hover", options.duration = 40.0, options.rate = 100.0;
  std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  const double w = 2 * M_PI * kHz;
  for (std::size_t i = 0; i < logs[0].rows(); ++i) {
    const double s = sway * std::sin(w * logs[0].t[i]);
    logs[0].x_W[1][i] += s;
    if (felt) logs[0].f_B[1][i] -= w * w * s;
  }
  const FlightRecord record = make_flight_record(vehicle, parameter_vector(vehicle), logs);
  const Theta theta(parameter_vector(vehicle), {}, 1, true);
  return spectral_lines(record, fit_flight(record, theta, {}));
}

TEST(SpectralLines, AStillFlightHasNone) { EXPECT_TRUE(lines_of(0.0, false).empty()); }

TEST(SpectralLines, WhatSwaysIsNamedWithItsFrequency) {
  const auto lines = lines_of(3e-4, true);
  ASSERT_FALSE(lines.empty());
  EXPECT_NEAR(lines[0].hz, kHz, 0.3);
}

// A sway that the accelerometer would feel much more, and does not, is none.
TEST(SpectralLines, WhatOnlyAnEstimatorShowsIsNoMotion) { EXPECT_TRUE(lines_of(3e-3, false).empty()); }

}  // namespace
}  // namespace ident
