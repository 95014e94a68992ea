// What a diagnosis makes of logs that lack signals or movement.
#include <gtest/gtest.h>

#include <random>

#include "ident/core/error.h"
#include "support/diagnosed.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using testing::flight_of;
using testing::known_to;
using testing::published_vehicle;
using testing::verdict_of;

// A path alone does not tell how the vehicle turned along it, and on the whole its rotors balance.
TEST(Diagnosis, APathWithoutRatesAndAttitudeTellsTheBalanceOfTheRotorsOnly) {
  FlightLog log = flight_of(published_vehicle(), 4);
  log.w_B = {}, log.f_B = {}, log.q_WB = {}, log.Omega = {};
  ASSERT_TRUE(log.has_position() && log.has_velocity() && log.has_commands());
  const Diagnosis found = diagnose_gap(published_vehicle(), std::vector<FlightLog>{log});
  EXPECT_EQ(found.result.extra["verdict"]["status"], "none");
  EXPECT_TRUE(found.result.has_warning("no_turning"));
}

// Linearised at zero a long delay gains most and yet looks as if its size changed from moment to moment.
// Logs without rates, or without attitude, are normal: states start far from their best there.
TEST(Diagnosis, NothingIsFoundWithoutRatesOrAttitude) {
  Vehicle model = published_vehicle();
  known_to(0.05, {"kT", "kQ", "km", "Jxx", "Jyy", "Jzz"}, model);
  FlightLog no_rates = flight_of(published_vehicle(), 3), no_attitude = no_rates;
  for (auto& column : no_rates.w_B) column.clear();
  for (auto& column : no_attitude.q_WB) column.clear();
  EXPECT_EQ(verdict_of(model, no_rates)["status"], "none");
  EXPECT_EQ(verdict_of(model, no_attitude)["status"], "none");
}

TEST(Diagnosis, HoverAloneTellsNoCause) {
  Vehicle model = published_vehicle();
  known_to(0.05, {"kT", "kQ", "km", "Jxx", "Jyy", "Jzz", "omega_m"}, model);
  FlightLog still = flight_of(published_vehicle(), 4);
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  const auto shake = [&](auto& columns, double sigma) {
    for (auto& column : columns)
      for (double& x : column) x += sigma * noise(random);
  };
  const double level =
      std::sqrt(model.value("m") * model.g / (4 * model.value("kT") * std::cos(slant_angle(model)))) /
      model.value("km");
  for (auto& column : still.delta) column.assign(column.size(), level);
  for (auto& column : still.Omega) column.assign(column.size(), level * model.value("km"));
  for (std::size_t k = 0; k < 3; ++k) {
    still.w_B[k].assign(still.t.size(), 0.0), still.v_W[k].assign(still.t.size(), 0.0);
    still.f_B[k].assign(still.t.size(), k == 2 ? -model.g : 0.0);
    still.x_W[k].assign(still.t.size(), k == 2 ? -2.0 : 0.0);
  }
  for (std::size_t k = 0; k < 4; ++k) still.q_WB[k].assign(still.t.size(), k == 0 ? 1.0 : 0.0);
  shake(still.w_B, 0.01), shake(still.f_B, 0.1), shake(still.v_W, 0.01), shake(still.x_W, 0.002);
  shake(still.Omega, 2.0), shake(still.q_WB, 5e-4);
  const auto verdict = verdict_of(model, still);
  EXPECT_NE(verdict["status"], "identified") << verdict;
  EXPECT_NE(verdict["status"], "ambiguous") << verdict;
}

// A shifted centre of gravity shows in hover and cannot be told there from a weak rotor: that is not `none`.
TEST(Diagnosis, WhatHoverShowsIsNotNone) {
  const Vehicle truth = testing::quad();
  const FlightLog straight = testing::hover(truth, 20), shifted = testing::hover(truth, 20, 0.005);
  EXPECT_EQ(verdict_of(testing::known(truth), straight)["status"], "none");
  const auto verdict = verdict_of(testing::known(truth), shifted);
  EXPECT_EQ(verdict["status"], "unknown") << verdict;
  EXPECT_NE(verdict["sentence"].get<std::string>().find("hover"), std::string::npos) << verdict;
}

// Clocks that differ are no dead time of a motor, and none is written.
TEST(Diagnosis, RotorsThatGoBeforeTheirCommandsAreNotNamed) {
  Vehicle model = testing::known(testing::quad());
  FlightLog log = testing::flight(testing::quad(), 250, 7, 25);
  log.Omega.clear();
  constexpr std::size_t late = 5;  // rows of 4 ms
  for (auto& column : log.delta) {
    column.insert(column.begin(), late, column.front());
    column.resize(log.t.size());
  }
  const Diagnosis found = diagnose_gap(model, std::vector<FlightLog>{log});
  EXPECT_EQ(found.result.extra["verdict"]["status"], "unknown") << found.result.extra["verdict"];
  EXPECT_TRUE(found.result.has_warning("negative_dead_time"));
  for (const Parameter& p : found.result.parameters) {
    const bool of_lag = p.name == "dead_time" || p.name == "omega_m" || p.name == "zeta_m";
    EXPECT_FALSE(of_lag && p.identifiable) << p.name;
  }
  EXPECT_GE(found.adopted.value("dead_time"), 0.0);
}

}  // namespace
}  // namespace ident
