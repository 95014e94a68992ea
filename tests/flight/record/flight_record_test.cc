// What a record takes from several logs together.
#include "ident/flight/record/flight_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/flight/make_record.h"
#include "ident/flight/prepare.h"
#include "ident/flight/record/excerpts.h"
#include "ident/sim/simulate.h"
#include "support/random_vehicle.h"

namespace ident {
namespace {

// km is one for all logs, and so is the voltage at which it holds: a flight begun on a half empty pack is a
// sagged one.
TEST(FlightRecord, AllLogsShareOneReferenceVoltage) {
  Vehicle vehicle = random_vehicle(1);
  vehicle.battery_voltage.reset();
  SimulationOptions options;
  options.duration = 3, options.rate = 100, options.longest_step = 0;
  std::vector<FlightLog> logs(2, simulate_flight(vehicle, options).log);
  logs[0].vbat.assign(logs[0].rows(), 12.0);
  logs[1].vbat.assign(logs[1].rows(), 10.2);
  std::vector<Warning> assumed;
  const auto ratio = [&](const Vehicle& of, int log) {
    const FlightRecord record = make_flight_record(of, starting_constants(of, logs, assumed), logs);
    const auto arc = std::ranges::find(record.arcs, log, &FlightArc::log);
    return arc->inputs->voltage_ratio.front();
  };
  EXPECT_DOUBLE_EQ(ratio(vehicle, 0), 1.0);
  EXPECT_DOUBLE_EQ(ratio(vehicle, 1), 10.2 / 12.0);
  vehicle.battery_voltage = 12.6;
  EXPECT_DOUBLE_EQ(ratio(vehicle, 1), 10.2 / 12.6);
}

// Motors are simulated for all logs or for none.
TEST(FlightRecord, LogsWithAndWithoutCommandsAreNotMixed) {
  const Vehicle vehicle = random_vehicle(2);
  SimulationOptions options;
  options.duration = 3, options.rate = 100, options.longest_step = 0;
  std::vector<FlightLog> logs(2, simulate_flight(vehicle, options).log);
  EXPECT_NO_THROW((void)make_flight_record(vehicle, parameter_vector(vehicle), logs));
  logs[1].delta.clear();
  EXPECT_THROW((void)make_flight_record(vehicle, parameter_vector(vehicle), logs), UsageError);
  logs[0].delta.clear();
  EXPECT_NO_THROW((void)make_flight_record(vehicle, parameter_vector(vehicle), logs));
}

// Motors nearly off: for a moment that is flown, for longer it is the ground.
TEST(FlightRecord, AShortPushOverBelongsToFlightAndALandingDoesNot) {
  const Vehicle vehicle = random_vehicle(3);
  SimulationOptions options;
  options.duration = 10, options.rate = 100, options.longest_step = 0;
  const FlightLog flown = simulate_flight(vehicle, options).log;
  for (const double seconds : {0.3, 1.0}) {
    std::vector<FlightLog> logs{flown};
    for (std::size_t i = 0; i < flown.rows(); ++i)
      if (flown.t[i] >= 5 && flown.t[i] < 5 + seconds)
        for (std::vector<double>& delta : logs[0].delta) delta[i] = 0.01;
    const FlightRecord record = make_flight_record(vehicle, parameter_vector(vehicle), logs);
    const bool excluded =
        std::ranges::find(record.warnings, "ground_excluded", &Warning::code) != record.warnings.end();
    EXPECT_EQ(excluded, seconds > 0.5);
    EXPECT_NEAR(record.duration, excluded ? 7.0 : 10.0, 0.1);  // a second before and after it too
  }
}

TEST(FlightRecord, AnExcerptHoldsItsShareOfEveryLog) {
  const Vehicle vehicle = random_vehicle(3);
  SimulationOptions options;
  options.duration = 40, options.rate = 100, options.longest_step = 0;
  std::vector<FlightLog> logs(2, simulate_flight(vehicle, options).log);
  // The second in arcs of 2 s: too short to be cut.
  for (std::size_t i = 0; i < logs[1].rows(); ++i) logs[1].t[i] += std::floor(logs[1].t[i] / 2.0);
  const FlightRecord record = make_flight_record(vehicle, parameter_vector(vehicle), logs);
  const FlightRecord excerpt = excerpt_of(record, 0.25, 4.0);
  EXPECT_NEAR(excerpt.duration, 0.25 * record.duration, 2.5);
  double of_first = 0, of_second = 0;
  for (const FlightArc& arc : excerpt.arcs) {
    const double seconds = arc.t.back() - arc.t.front();
    EXPECT_GT(seconds, 1.5);
    (arc.log == 0 ? of_first : of_second) += seconds;
  }
  EXPECT_NEAR(of_first, 10.0, 1.0);
  EXPECT_NEAR(of_second, 10.0, 2.5);
}

}  // namespace
}  // namespace ident
