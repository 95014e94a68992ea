// A battery that sags, where the vehicle file says at which voltage km holds, and where it does not.
#include <gtest/gtest.h>

#include "ident/effects/catalogue.h"
#include "ident/gap/diagnose.h"
#include "ident/sim/simulate.h"
#include "support/known_quad.h"

namespace ident {
namespace {

TEST(DiagnoseBattery, SaysWhichVoltageItCountsFromWhereNoneIsStated) {
  const Vehicle model = testing::known(testing::quad());
  Vehicle truth = testing::quad();
  truth.battery_voltage = 12.0, truth.parameters["battery_sag.n"] = {0.7, {}};
  SimulationOptions options;
  options.rate = 100.0, options.seed = 3, options.duration = 40, options.battery_used = 0.2;
  options.signals.rotor_speeds = 0;
  const FlightLog log = simulate_flight(truth, options).log;
  for (const bool stated : {true, false}) {
    Vehicle given = model;
    if (stated) given.battery_voltage = 12.0;
    const Result found = diagnose_gap(given, std::span(&log, 1), {.shown = Shown::numbers}).result;
    EXPECT_EQ(found.extra["verdict"]["effects"], nlohmann::ordered_json{"battery_sag"})
        << found.extra["verdict"].dump();
    EXPECT_EQ(found.has_warning("battery_voltage"), !stated);
  }
}

}  // namespace
}  // namespace ident
