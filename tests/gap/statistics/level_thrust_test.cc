// The battery read off thrust and commands, on simulated flights.
#include "ident/gap/statistics/level_thrust.h"

#include <gtest/gtest.h>

#include "ident/effects/catalogue.h"
#include "ident/flight/make_record.h"
#include "support/published_hover.h"

namespace ident {
namespace {

// Two flights of a minute of the published vehicle on a battery that loses `used` of its voltage, taken for
// one without sag.
LevelThrust found_with(double n, double used, int logs = 2, bool force = true) {
  Vehicle truth = testing::published_vehicle();
  truth.battery_voltage = 12.0;
  const Vehicle model = truth;
  if (n > 0) truth.parameters["battery_sag.n"] = {n, {}};
  std::vector<FlightLog> flown;
  for (int k = 0; k < logs; ++k) {
    SimulationOptions options;
    options.rate = 100.0;
    options.seed = static_cast<std::uint64_t>(k + 1);
    options.battery_used = used;
    if (!force) options.signals.force = 0;
    flown.push_back(simulate_flight(truth, options).log);
  }
  const std::vector<double> p = parameter_vector(model);
  return level_thrust(make_flight_record(model, p, flown), p);
}

TEST(LevelThrust, ASaggingBatteryIsPlainAndHasItsExponent) {
  const LevelThrust seen = found_with(0.7, 0.2);
  EXPECT_TRUE(seen.plain());
  EXPECT_EQ(seen.logs, 2);
  EXPECT_NEAR(seen.n, 0.7, 0.05);
  EXPECT_LT(seen.n_std, 0.05);
  EXPECT_LT(seen.left, 0.3 * seen.varies);
}

TEST(LevelThrust, AVoltageWithoutConsequenceIsNot) {
  const LevelThrust seen = found_with(0.0, 0.2);
  EXPECT_EQ(seen.logs, 2);
  EXPECT_FALSE(seen.plain());
  EXPECT_NEAR(seen.n, 0.0, 0.05);
}

TEST(LevelThrust, OneLogOrNoForceIsTooLittle) {
  EXPECT_FALSE(found_with(0.7, 0.2, 1).plain());
  EXPECT_EQ(found_with(0.7, 0.2, 2, false).stretches, 0);
}

}  // namespace
}  // namespace ident
