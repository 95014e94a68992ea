// Constants that a vehicle file is silent about: estimated where the flight contradicts what silence means,
// and only there.
#include <gtest/gtest.h>

#include <cmath>

#include "ident/estimators/flight_refine.h"
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
  stated.parameters.erase("dead_time"), stated.parameters.erase("Omega_0");
  return stated;
}

void expect_near_truth(const Result& result, const Vehicle& truth, const char* name) {
  const Parameter* p = result.find(name);
  ASSERT_NE(p, nullptr) << name;
  EXPECT_NEAR(p->value, truth.value(name), 4 * p->std) << name;
}

TEST(Watched, NothingIsEstimatedThatNothingContradicts) {
  const Vehicle truth = quad(0.0);
  const Result result = refined(truth, silent(truth));
  for (const char* name : {"dead_time", "Omega_0"}) EXPECT_EQ(result.find(name), nullptr) << name;
  for (const char* code : {"dead_time", "command_offset"}) EXPECT_FALSE(result.has_warning(code)) << code;
}

// Held at zero it makes omega_m a tenth less than it is, with a hundredth of that as deviation.
TEST(Watched, DeadTimeThatIsNotStatedIsEstimatedWhereTheFlightShowsOne) {
  for (const double dead_time : {0.002, 0.012}) {
    const Vehicle truth = quad(dead_time);
    const Result result = refined(truth, silent(truth));
    EXPECT_TRUE(result.has_warning("dead_time"));
    EXPECT_FALSE(result.has_warning("command_offset"));
    for (const char* name : {"dead_time", "omega_m", "zeta_m"}) expect_near_truth(result, truth, name);
    EXPECT_LT(result.find("dead_time")->std, 0.0005);
  }
}

TEST(Watched, BothAtOnce) {
  Vehicle truth = quad(0.006);
  truth.parameters["Omega_0"] = {150, {}};
  const Result result = refined(truth, silent(truth));
  EXPECT_TRUE(result.has_warning("dead_time"));
  EXPECT_TRUE(result.has_warning("command_offset"));
  for (const char* name : {"dead_time", "Omega_0", "omega_m", "zeta_m", "km"})
    expect_near_truth(result, truth, name);
}

TEST(Watched, WhatIsStatedIsHeld) {
  const Vehicle truth = quad(0.006);
  Vehicle stated = silent(truth);
  stated.parameters["dead_time"] = {0.0, {}};
  const Result held = refined(truth, stated);
  EXPECT_EQ(held.find("dead_time"), nullptr);
  EXPECT_FALSE(held.has_warning("dead_time"));
  EXPECT_GT(std::abs(held.find("omega_m")->value - truth.value("omega_m")), 10 * held.find("omega_m")->std);
}

TEST(Watched, WhatIsAskedForIsNoFinding) {
  const Vehicle truth = quad(0.006);
  const Result result = refined(truth, silent(truth), {.free = {"dead_time"}, .validate = false});
  expect_near_truth(result, truth, "dead_time");
  EXPECT_FALSE(result.has_warning("dead_time"));
}

}  // namespace
}  // namespace ident
