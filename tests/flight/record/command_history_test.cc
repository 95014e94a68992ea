// Rows that are lost take their commands with them.
#include "ident/flight/record/command_history.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/random.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "support/known_quad.h"

namespace ident {
namespace {

double ramp(double t) { return 0.3 + 0.1 * t; }

/// Commands of one rotor that grow along a ramp, at these times.
FlightLog at_times(const std::vector<double>& t) {
  FlightLog log;
  log.t = t;
  log.delta.emplace_back();
  for (const double time : t) log.delta[0].push_back(ramp(time));
  return log;
}

std::vector<double> hundredths(int rows) {
  std::vector<double> t;
  for (int i = 0; i < rows; ++i) t.push_back(0.01 * i);
  return t;
}

double command_at(const FlightLog& log, double t) {
  return command_history(log, log.t.front(), log.t.back())[0].at(t);
}

TEST(CommandHistory, HoldsFromRowToRow) {
  const FlightLog log = at_times(hundredths(100));
  EXPECT_NEAR(command_at(log, 0.5049), ramp(0.50), 1e-12);
  EXPECT_NEAR(command_at(log, -1.0), ramp(0.0), 1e-12);
  EXPECT_NEAR(command_at(log, 5.0), ramp(0.99), 1e-12);
}

TEST(CommandHistory, GoesAlongALineOverLostRows) {
  std::vector<double> t = hundredths(100);
  t.erase(t.begin() + 41, t.begin() + 44);
  const FlightLog log = at_times(t);
  EXPECT_NEAR(command_at(log, 0.4049), ramp(0.40), 1e-12);
  EXPECT_NEAR(command_at(log, 0.4249), ramp(0.42), 1e-12);
  EXPECT_NEAR(command_at(log, 0.4349), ramp(0.43), 1e-12);
  EXPECT_NEAR(command_at(log, 0.4449), ramp(0.44), 1e-12);
}

TEST(CommandHistory, IsHeldWhereALogHasNoUsualStepAndOverALongHole) {
  std::vector<double> uneven;
  for (int i = 0; i < 100; ++i) uneven.push_back(0.01 * i + (i % 3 == 2 ? 0.009 : 0.0));
  EXPECT_NEAR(command_at(at_times(uneven), 0.4649), ramp(0.46), 1e-12);
  std::vector<double> hole = hundredths(100);
  hole.erase(hole.begin() + 41, hole.begin() + 61);
  EXPECT_NEAR(command_at(at_times(hole), 0.55), ramp(0.40), 1e-12);
}

TEST(CommandHistory, OfPartOfALogEqualsThatOfTheWhole) {
  const FlightLog log = at_times(hundredths(100));
  const HeldCommand part = command_history(log, 0.305, 0.6)[0];
  EXPECT_NEAR(part.at(0.306), ramp(0.30), 1e-12);
  EXPECT_NEAR(part.at(0.5949), ramp(0.59), 1e-12);
  EXPECT_NEAR(part.at(0.1), ramp(0.30), 1e-12) << "the first";
}

/// The log without rows: `losses` times up to `longest` seconds of them.
FlightLog with_losses(const FlightLog& log, int losses, double longest) {
  Random random(11);
  std::vector<bool> lost(log.rows());
  for (int k = 0; k < losses; ++k) {
    const double from = random.uniform(1.0, log.t.back()), to = from + random.uniform(0.01, longest);
    for (std::size_t i = 0; i < log.rows(); ++i)
      if (log.t[i] > from && log.t[i] < to) lost[i] = true;
  }
  FlightLog out = log;
  const auto thin = [&](std::vector<double>& column) {
    std::vector<double> left;
    for (std::size_t i = 0; i < column.size(); ++i)
      if (!lost[i]) left.push_back(column[i]);
    column = std::move(left);
  };
  thin(out.t);
  for (auto* group : {&out.delta, &out.Omega}) std::ranges::for_each(*group, thin);
  for (auto* group : {&out.w_B, &out.f_B, &out.x_W, &out.v_W}) std::ranges::for_each(*group, thin);
  std::ranges::for_each(out.q_WB, thin);
  return out;
}

// Of both kinds: many short holes, and so many long ones that half of the flight is gone.
TEST(CommandHistory, ALogWithHolesGivesUnbiasedMotorsAndInertia) {
  const Vehicle vehicle = testing::known(testing::quad());
  FlightLog whole = testing::flight(testing::quad(), 250, 3, 40);
  whole.Omega.clear();
  for (const auto& [losses, longest] : {std::pair(300, 0.016), {60, 0.24}}) {
    const Result result =
        refine_flight(vehicle, std::vector{with_losses(whole, losses, longest)}, {.validate = false});
    for (const char* name : {"omega_m", "zeta_m", "Jxx", "Jyy"}) {
      const Parameter& p = *result.find(name);
      EXPECT_TRUE(p.identifiable) << name << ", " << losses << " holes";
      EXPECT_NEAR(p.value / testing::quad().value(name), 1.0, 0.02) << name << ", " << losses << " holes";
      EXPECT_LT(std::abs(p.value - testing::quad().value(name)), 4 * p.std) << name;
    }
  }
}

TEST(CommandHistory, CommandsJumpWhereTheyAreHeldForLong) {
  FlightLog log = at_times(hundredths(400));
  EXPECT_EQ(command_jumps(log).size(), 400u);  // a new one every 10 ms
  for (std::size_t i = 0; i < log.t.size(); ++i) log.t[i] = 0.0025 * static_cast<double>(i);
  EXPECT_TRUE(command_jumps(log).empty());
  for (std::size_t i = 0; i < log.t.size(); ++i) log.delta[0][i] = log.delta[0][i - i % 10];
  const std::vector<double> jumps = command_jumps(log);  // one in ten rows brings one
  ASSERT_GE(jumps.size(), 39u);
  for (std::size_t k = 1; k < jumps.size(); ++k) EXPECT_NEAR(jumps[k] - jumps[k - 1], 0.025, 1e-9);
}

}  // namespace
}  // namespace ident
