// Commands that were flown at 250 Hz and logged more seldom.
#include "ident/flight/checks/command_rate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/random.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using Columns = std::vector<std::vector<double>>;

std::vector<double> hundredths(std::size_t rows) {
  std::vector<double> t;
  for (std::size_t i = 0; i < rows; ++i) t.push_back(0.01 * static_cast<double>(i));
  return t;
}

Columns noise(std::size_t rows) {
  Random random(3);
  Columns columns(4, std::vector<double>(rows));
  for (auto& column : columns)
    for (double& x : column) x = 0.5 + 0.05 * random.normal();
  return columns;
}

// Of every `every`-th row; in between it holds, or there is none.
Columns logged_each(Columns columns, std::size_t every, bool hold) {
  for (auto& column : columns)
    for (std::size_t i = 0; i < column.size(); ++i)
      if (i % every > 0) column[i] = hold ? column[i - i % every] : kNaN;
  return columns;
}

TEST(SeldomCommands, AreTimedByTheRowsThatBringNewOnes) {
  const std::vector<double> t = hundredths(400);
  const Columns each = noise(400);
  EXPECT_NEAR(new_samples(t, each).apart, 0.01, 1e-12);
  EXPECT_NEAR(new_samples(t, logged_each(each, 5, true)).apart, 0.05, 1e-12);
  EXPECT_NEAR(new_samples(t, logged_each(each, 5, false)).apart, 0.05, 1e-12);
  EXPECT_TRUE(std::isnan(new_samples(t, {}).apart));
  EXPECT_TRUE(std::isnan(new_samples(t, logged_each(each, 400, false)).apart));
}

TEST(SeldomCommands, AreNotThoseThatChangeByCoarseStepsNowAndThen) {
  const std::vector<double> t = hundredths(400);
  Columns coarse(4, std::vector<double>(400));
  for (std::size_t n = 0; n < 4; ++n)
    for (std::size_t i = 0; i < 400; ++i)
      coarse[n][i] = std::round(100 * (0.5 + 0.05 * std::sin(0.1 * static_cast<double>(i + 7 * n)))) / 100;
  EXPECT_NEAR(new_samples(t, coarse).apart, 0.01, 1e-12);
  for (std::size_t n = 1; n < 4; ++n) coarse[n] = coarse[0];  // all alike, as a vehicle that climbs
  EXPECT_NEAR(new_samples(t, coarse).apart, 0.01, 1e-12);
}

TEST(SeldomCommands, AreRoughWhereTheyHaveNothingToDoWithTheOnesBefore) {
  FlightLog log;
  log.t = hundredths(400);
  log.delta = noise(400);
  EXPECT_NEAR(roughness(log), 1.0, 0.1);
  log.delta = logged_each(log.delta, 4, true);
  EXPECT_NEAR(roughness(log), 1.0, 0.2);
  for (std::size_t i = 0; i < 400; ++i)
    for (auto& column : log.delta) column[i] = std::sin(0.01 * static_cast<double>(i));
  EXPECT_NEAR(roughness(log), 1.0 / 25, 0.005);
}

// Flown by the rates of a gyro, so that commands are as rough as an autopilot's.
FlightLog flown(bool speeds) {
  SimulationOptions options;
  options.duration = 30, options.by_gyro = true, options.signals.rotor_speeds = speeds ? 1 : 0;
  return simulate_flight(testing::quad(), options).log;
}

bool is_known(const Result& result, const char* name) { return result.find(name)->identifiable; }

TEST(SeldomCommands, LeaveMotorsAndInertiaOpen) {
  FlightLog log = flown(false);
  log.delta = logged_each(log.delta, 12, true);
  const Vehicle vehicle = testing::known(testing::quad());
  const Result result = refine_flight(vehicle, std::vector{log}, {.validate = false});
  EXPECT_TRUE(result.has_warning("seldom_commands"));
  for (const char* name : {"omega_m", "zeta_m", "dead_time", "Jxx", "Jyy", "Jzz"})
    EXPECT_FALSE(is_known(result, name)) << name;

  const Result often = refine_flight(vehicle, std::vector{flown(false)}, {.validate = false});
  EXPECT_FALSE(often.has_warning("seldom_commands"));
  for (const char* name : {"omega_m", "Jxx", "Jyy"}) EXPECT_TRUE(is_known(often, name)) << name;
}

TEST(SeldomCommands, GiveWayToSpeedsThatWereLoggedMoreOften) {
  FlightLog log = flown(true);
  log.delta = logged_each(log.delta, 12, false);
  const Result result = refine_flight(testing::known(testing::quad()), std::vector{log}, {.validate = false});
  EXPECT_TRUE(result.has_warning("seldom_commands"));
  EXPECT_EQ(result.find("omega_m"), nullptr);
  for (const char* name : {"Jxx", "Jyy"}) {
    EXPECT_TRUE(is_known(result, name)) << name;
    EXPECT_NEAR(result.find(name)->value / testing::quad().value(name), 1.0, 0.02) << name;
  }
}

TEST(SeldomCommands, SpeedsThatAreSeldomLeaveInertiaOpenWhereTheyAreAllThereIs) {
  FlightLog log = flown(true);
  log.delta.clear();
  log.Omega = logged_each(log.Omega, 12, false);
  const Result result = refine_flight(testing::known(testing::quad()), std::vector{log}, {.validate = false});
  EXPECT_TRUE(result.has_warning("seldom_speeds"));
  for (const char* name : {"Jxx", "Jyy", "Jzz"}) EXPECT_FALSE(is_known(result, name)) << name;
}

}  // namespace
}  // namespace ident
