// Constants that a vehicle file is silent about: estimated where the flight contradicts what silence means,
// and only there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using testing::flight;
using testing::known;
using testing::quad;

Result refined(const Vehicle& truth, const Vehicle& stated,
               const RefineOptions& options = {.validate = false}) {
  const FlightLog log = flight(truth, 250, 1);
  return refine_flight(stated, std::span(&log, 1), options);
}

Vehicle silent(const Vehicle& truth) {
  Vehicle stated = known(truth);
  for (const char* name : {"dead_time", "Omega_0", "Jp"}) stated.parameters.erase(name);
  return stated;
}

// Within four deviations, which are that share of the value at most.
void expect_known(const Result& result, const Vehicle& truth, const char* name, double share) {
  const Parameter* p = result.find(name);
  ASSERT_NE(p, nullptr) << name;
  EXPECT_NEAR(p->value, truth.value(name), 4 * p->std) << name;
  EXPECT_LT(p->std, share * truth.value(name)) << name;
  EXPECT_TRUE(p->identifiable) << name;
}

TEST(Watched, AHeldConstantStaysHeldWithoutContradiction) {
  Vehicle truth = quad(0.0);
  truth.parameters["Jp"].value = 0;
  const Result result = refined(truth, silent(truth));
  for (const char* name : {"dead_time", "Omega_0", "Jp"}) EXPECT_EQ(result.find(name), nullptr) << name;
  for (const char* code : {"dead_time", "command_offset", "rotor_inertia"})
    EXPECT_FALSE(result.has_warning(code)) << code;
}

// Held at zero it makes Jzz half of what it is, with a tenth of that as deviation.
TEST(Watched, RotorInertiaThatIsNotStatedIsEstimated) {
  const Vehicle truth = quad(0.0);
  const Result result = refined(truth, silent(truth));
  EXPECT_TRUE(result.has_warning("rotor_inertia"));
  EXPECT_FALSE(result.has_warning("dead_time"));
  for (const char* name : {"Jp", "Jzz", "kQ"}) expect_known(result, truth, name, 0.05);
}

// Nothing stated of the yaw, no rotor speeds: Jzz would take the place of Jp, a quarter too small and sure of
// it, and gusts about yaw the rest.
TEST(Watched, RotorInertiaIsFreeFromTheStartWithoutAPriorOfJzz) {
  Vehicle truth = quad(0.0);
  truth.parameters["Jp"].value = 2e-5;
  Vehicle stated = truth;
  std::erase_if(stated.parameters, [](const auto& p) { return p.first != "m"; });
  FlightLog log = flight(truth, 250, 1);
  log.Omega.clear();
  const Result result = refine_flight(stated, std::span(&log, 1), {.validate = false});
  EXPECT_TRUE(result.has_warning("rotor_inertia"));
  expect_known(result, truth, "Jzz", 0.05);
  // By itself it is not told, and yet it is there: Jp km is told.
  ASSERT_NE(result.find("Jp"), nullptr);
  EXPECT_FALSE(result.find("Jp")->identifiable);
  EXPECT_NEAR(result.find("Jp")->value * result.find("km")->value, truth.value("Jp") * truth.value("km"),
              0.1 * truth.value("Jp") * truth.value("km"));
}

// A vehicle whose rotors' momentum has the other sign than the model's.
TEST(Watched, NegativeRotorInertiaMakesYawConstantsUnidentifiable) {
  Vehicle truth = quad(0.0);
  truth.signs = Signs::as_published, truth.parameters["Jp"].value = 3e-7;  // which it can fly with
  Vehicle stated = silent(truth);
  const Result as_flown = refined(truth, stated);
  expect_known(as_flown, truth, "Jp", 0.05);
  stated.signs = Signs::first_principles;
  const Result result = refined(truth, stated);
  EXPECT_TRUE(result.has_warning("negative_rotor_inertia"));
  EXPECT_FALSE(result.has_warning("rotor_inertia"));
  for (const char* name : {"Jp", "Jzz", "kQ"}) EXPECT_FALSE(result.find(name)->identifiable) << name;
}

// Held at zero it makes omega_m a tenth less than it is, with a hundredth of that as deviation.
TEST(Watched, DeadTimeThatIsNotStatedIsEstimatedWhereTheFlightShowsOne) {
  for (const double dead_time : {0.002, 0.012, 0.03}) {
    const Vehicle truth = quad(dead_time);
    const Result result = refined(truth, silent(truth));
    EXPECT_TRUE(result.has_warning("dead_time"));
    EXPECT_FALSE(result.has_warning("command_offset"));
    expect_known(result, truth, "dead_time", 0.0002 / dead_time);
    for (const char* name : {"omega_m", "zeta_m"}) expect_known(result, truth, name, 0.01);
  }
}

// A dead time of 60 ms looks like an offset to begin with.
TEST(Watched, AFreedConstantThatTurnsOutToBeZeroIsHeldAgain) {
  const Vehicle truth = quad(0.06);
  const FlightLog log = flight(truth, 250, 1, 20);
  const Result result = refine_flight(silent(truth), std::span(&log, 1), {.validate = false});
  EXPECT_FALSE(result.has_warning("command_offset"));
  EXPECT_EQ(result.find("Omega_0"), nullptr);
  expect_known(result, truth, "dead_time", 0.01);
}

TEST(Watched, WithoutCommandsNoMotorConstantIsTested) {
  const Vehicle truth = quad(0.006);
  FlightLog log = flight(truth, 250, 1);
  log.delta.clear();
  const Result result = refine_flight(silent(truth), std::span(&log, 1), {.validate = false});
  for (const char* name : {"dead_time", "Omega_0", "km", "omega_m"}) EXPECT_EQ(result.find(name), nullptr);
  EXPECT_TRUE(result.has_warning("rotor_inertia"));
  for (const char* name : {"Jp", "Jzz"}) expect_known(result, truth, name, 0.1);
}

TEST(Watched, TenSecondsAreEnough) {
  for (const double dead_time : {0.0, 0.006}) {
    const Vehicle truth = quad(dead_time);
    const FlightLog log = flight(truth, 250, 1, 10);
    const Result result = refine_flight(silent(truth), std::span(&log, 1), {.validate = false});
    EXPECT_EQ(result.has_warning("dead_time"), dead_time > 0);
    EXPECT_FALSE(result.has_warning("command_offset"));
    if (dead_time > 0) expect_known(result, truth, "dead_time", 0.05);
    expect_known(result, truth, "omega_m", 0.02);
  }
}

TEST(Watched, OffsetAndDeadTimeAreFoundTogetherInTwoLogs) {
  Vehicle truth = quad(0.006);
  truth.parameters["Omega_0"] = {150, {}};
  const std::vector<FlightLog> logs = {flight(truth, 250, 1, 30), flight(truth, 200, 2, 30)};
  const Result result = refine_flight(silent(truth), logs, {.validate = false});
  EXPECT_TRUE(result.has_warning("dead_time"));
  EXPECT_TRUE(result.has_warning("command_offset"));
  for (const char* name : {"dead_time", "Omega_0", "omega_m", "zeta_m", "km"})
    expect_known(result, truth, name, 0.04);
}

// The log shows commands 8 ms after they were given.
TEST(Watched, LateCommandsMakeTheMotorLagUnidentifiable) {
  const Vehicle truth = quad(0.0);
  FlightLog log = flight(truth, 250, 1);
  for (std::vector<double>& delta : log.delta) {
    std::rotate(delta.begin(), delta.end() - 2, delta.end());
    delta[0] = delta[1] = delta[2];
  }
  const Result result = refine_flight(silent(truth), std::span(&log, 1), {.validate = false});
  EXPECT_TRUE(result.has_warning("negative_dead_time"));
  EXPECT_FALSE(result.has_warning("dead_time"));
  EXPECT_NEAR(result.find("dead_time")->value, -0.008, 4 * result.find("dead_time")->std);
  for (const char* name : {"dead_time", "omega_m", "zeta_m"})
    EXPECT_FALSE(result.find(name)->identifiable) << name;
}

// Motors of which nothing is known take a delay of 20 ms for no lag, and what that leaves for an offset.
TEST(Watched, VeryLateCommandsDoNotFreeAnOffset) {
  Vehicle truth = quad(0.0);
  truth.parameters["omega_m"].value = 45, truth.parameters["zeta_m"].value = 1;
  Vehicle stated = silent(truth);
  for (const char* name : {"omega_m", "zeta_m"}) stated.parameters.erase(name);
  FlightLog log = flight(truth, 250, 1);
  for (auto& command : log.delta) {
    std::copy_backward(command.begin(), command.end() - 5, command.end());
    std::fill_n(command.begin(), 5, command[5]);
  }
  const Result result = refine_flight(stated, std::span(&log, 1), {.validate = false});
  EXPECT_FALSE(result.has_warning("command_offset"));
  EXPECT_TRUE(result.has_warning("negative_dead_time"));
  EXPECT_NEAR(result.find("dead_time")->value, truth.value("dead_time") - 0.02, 2e-3);
  for (const char* name : {"kT", "Jxx", "Jyy"}) expect_known(result, truth, name, 0.1);
}

TEST(Watched, WhatIsStatedIsHeld) {
  const Vehicle truth = quad(0.006);
  for (const char* name : {"dead_time", "motor_delay.tau"}) {
    Vehicle stated = silent(truth);
    stated.parameters[name] = {0.0, {}};
    const Result held = refined(truth, stated);
    EXPECT_EQ(held.find("dead_time"), nullptr);
    EXPECT_FALSE(held.has_warning("dead_time"));
    EXPECT_GT(std::abs(held.find("omega_m")->value - truth.value("omega_m")), 10 * held.find("omega_m")->std);
  }
}

TEST(Watched, AConstantFreedByTheUserIsNoFinding) {
  const Vehicle truth = quad(0.006);
  const Result result = refined(truth, silent(truth), {.free = {"dead_time"}, .validate = false});
  expect_known(result, truth, "dead_time", 0.03);
  EXPECT_FALSE(result.has_warning("dead_time"));
  const Result delay = refined(truth, silent(truth), {.free = {"motor_delay.tau"}, .validate = false});
  EXPECT_EQ(delay.find("dead_time"), nullptr);
  EXPECT_NEAR(delay.find("motor_delay.tau")->value, 0.006, 4 * delay.find("motor_delay.tau")->std);
}

}  // namespace
}  // namespace ident
