// Bursts: found where accelerations from outside jump, not in steady gusts.
#include "ident/gap/bursts.h"

#include <gtest/gtest.h>

#include "ident/core/random.h"
#include "support/published_hover.h"

namespace ident {
namespace {

// A fit whose smoothed accelerations are steady gusts, with a burst of `burst` m/s^2 downwards over two
// pieces.
std::vector<Burst> found_with(double burst, double* at = nullptr) {
  const Vehicle vehicle = testing::published_vehicle();
  const FlightRecord record = testing::hover_record(vehicle, vehicle, 20.0);
  const std::vector<double> p = parameter_vector(vehicle);
  const Theta theta(p, {}, 1, true);
  FlightFit fit;
  fit.noise = initial_noise(record);
  fit.smoother = std::make_shared<FlightSmoother>(record, theta, fit.noise, 0.1);
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

}  // namespace
}  // namespace ident
