// Whether commands held from row to row is told by the flight itself.
#include "ident/flight/checks/intersample_commands.h"

#include <gtest/gtest.h>

#include "ident/flight/checks/command_rate.h"
#include "ident/flight/fit/loop_timing.h"
#include "ident/flight/make_record.h"
#include "ident/flight/record/command_history.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "support/known_quad.h"
#include "support/thinned.h"

namespace ident {
namespace {

// Flown by the rates of a gyro, whose noise is in the commands.
FlightLog flown(double rate) {
  SimulationOptions options;
  options.duration = 20, options.by_gyro = true, options.rate = rate, options.seed = 11;
  options.signals.rotor_speeds = 0;
  return simulate_flight(testing::quad(), options).log;
}

TEST(HeldCommands, ThatHoldAreNotDoubted) {
  const Vehicle vehicle = testing::known(testing::quad());
  for (const double rate : {100.0, 125.0}) {
    const FlightLog log = flown(rate);
    EXPECT_GT(roughness(log), 0.18);  // and they were looked at
    const Result result = refine_flight(vehicle, std::vector{log}, {.validate = false});
    EXPECT_FALSE(result.has_warning("commands_between_rows")) << rate;
    EXPECT_TRUE(result.find("omega_m")->identifiable) << rate;
  }
}

TEST(HeldCommands, OfAControllerThatIsFasterThanItsLogAreToldByTheFlight) {
  const Vehicle vehicle = testing::known(testing::quad());
  const FlightLog log = testing::thinned(flown(1000), 10);
  const Result result = refine_flight(vehicle, std::vector{log}, {.validate = false});
  EXPECT_TRUE(result.has_warning("commands_between_rows"));
  for (const char* name : {"omega_m", "zeta_m", "dead_time", "Jp"})
    EXPECT_FALSE(result.find(name)->identifiable) << name;
  EXPECT_TRUE(result.find("km")->identifiable);
}

// 4 times what was expected of commands that hold is as good as nothing of it.
TEST(HeldCommands, AreRefutedByMoreThanChance) {
  EXPECT_FALSE((HeldCommands{.better = 0.0, .expected = 0.0}).refuted());
  EXPECT_FALSE((HeldCommands{.better = 100.0, .expected = 100.0}).refuted());
  EXPECT_FALSE((HeldCommands{.better = -4.0, .expected = 1.0}).refuted());  // chance
  EXPECT_TRUE((HeldCommands{.better = -6.0, .expected = 1.0}).refuted());
  EXPECT_TRUE((HeldCommands{.better = 400.0, .expected = 100.0}).refuted());
  EXPECT_FALSE((HeldCommands{.better = 200.0, .expected = 100.0}).refuted());  // in gusts
  EXPECT_TRUE((HeldCommands{.better = 2000.0, .expected = 1000.0}).refuted());
  EXPECT_TRUE((HeldCommands{.better = -100.0, .expected = 100.0}).refuted());
  EXPECT_FALSE((HeldCommands{.better = 8e5, .expected = 1e6}).refuted());  // of steps that were not the last
}

// An offset of the command is told by how thrust goes with it, and what was flown in between is not known.
TEST(HeldCommands, ThatALogStatesToHaveSkippedAreRefuted) {
  EXPECT_TRUE((HeldCommands{.better = 100.0, .expected = 100.0, .skipped = true}).refuted());
  FlightLog log;
  EXPECT_FALSE(commands_are_skipped(std::vector<FlightLog>{log}));
  log.loop = 0.0025;
  EXPECT_TRUE(commands_are_skipped(std::vector<FlightLog>{log}));
  log.each_command = true;
  EXPECT_FALSE(commands_are_skipped(std::vector<FlightLog>{log}));
}

TEST(HeldCommands, RefutedLeaveOpenAnOffsetThatTheyAskedFor) {
  const Vehicle vehicle = testing::known(testing::quad());
  const std::vector<FlightLog> logs{flown(250)};
  const FlightRecord record = make_flight_record(vehicle, parameter_vector(vehicle), logs);
  for (const bool offset : {false, true}) {
    Result result;
    for (const char* name : {"km", "kT", "omega_m", "Jxx"})
      result.parameters.push_back({.name = name, .value = 1.0, .std = 0.01});
    if (offset) result.warn("command_offset", "");
    doubt_commands_between_rows(result, record, logs, {.better = -100.0, .expected = 100.0});
    std::string open;
    for (const Parameter& p : result.parameters) open += p.identifiable ? "" : p.name + " ";
    EXPECT_EQ(open, offset ? "km kT omega_m " : "omega_m ");
  }
}

TEST(HeldCommands, ThatAreRarerThanRatesHaveToBeConfirmed) {
  const auto every_other = [](FlightLog log) {
    for (auto& column : log.delta)
      for (std::size_t i = 1; i < column.size(); i += 2) column[i] = column[i - 1];  // as they are read
    return log;
  };
  const Vehicle vehicle = testing::known(testing::quad());
  FlightLog slow = flown(100), fast = every_other(testing::thinned(flown(400), 2));
  EXPECT_FALSE(commands_are_rarer_than_rates(slow));
  EXPECT_TRUE(commands_are_rarer_than_rates(fast));
  EXPECT_TRUE(
      refine_flight(vehicle, std::vector{fast}, {.validate = false}).has_warning("commands_between_rows"));
  EXPECT_TRUE((HeldCommands{.better = 50, .expected = 50, .rare = true}).doubtful());
  EXPECT_TRUE((HeldCommands{.better = 600, .expected = 500, .rare = true}).doubtful());
  EXPECT_FALSE((HeldCommands{.better = 520, .expected = 500, .rare = true}).doubtful());
  EXPECT_FALSE((HeldCommands{.better = 50, .expected = 50, .rare = false}).doubtful());
}

TEST(HeldCommands, AlongLinesGoOnToTheNextInSteps) {
  FlightLog log;
  log.t = {0.0, 0.01, 0.02, 0.03, 0.5};
  log.delta = {{0.1, 0.5, 0.3, 0.3, 0.9}};
  const HeldCommand line = commands_along_lines(log, 0.0, 1.0, 4)[0];
  EXPECT_DOUBLE_EQ(line.at(0.0), 0.1);
  EXPECT_DOUBLE_EQ(line.at(0.0051), 0.3);
  EXPECT_DOUBLE_EQ(line.at(0.0099), 0.4);
  EXPECT_DOUBLE_EQ(line.at(0.0101), 0.5);
  EXPECT_DOUBLE_EQ(line.at(0.4), 0.3);  // over a gap there is no line
  EXPECT_DOUBLE_EQ(line.at(0.6), 0.9);
  log.delta.push_back(std::vector<double>(5, kNaN));  // a rotor of which nothing was logged
  EXPECT_DOUBLE_EQ(commands_along_lines(log, 0.0, 1.0, 4)[0].at(0.6), 0.9);
  EXPECT_DOUBLE_EQ(commands_along_lines(log, 0.0, 1.0, 4)[1].at(0.6), 0.0);
}

// Rates a row late against the attitude: commands may be in time with either.
TEST(DeadTime, IsAsUncertainAsRatesAndAttitudeAreApart) {
  const Vehicle vehicle = testing::known(testing::quad());
  FlightLog log = testing::flight(testing::quad(), 250, 3, 20.0);
  const auto deviation = [&] {
    return refine_flight(vehicle, std::vector{log}, {.validate = false}).find("dead_time")->std;
  };
  EXPECT_LT(deviation(), 0.5e-3);
  for (std::vector<double>& rate : log.w_B)
    for (std::size_t i = rate.size() - 1; i > 0; --i) rate[i] = rate[i - 1];
  EXPECT_NEAR(deviation(), 4e-3, 0.6e-3);
}

}  // namespace
}  // namespace ident
