// A real flight against a simulated one of other commands and another path.
#include "ident/gap/comparison/compare.h"

#include <gtest/gtest.h>

#include "support/diagnosed.h"

namespace ident {
namespace {

using namespace testing;  // flights of support/, not GoogleTest's

Vehicle stated() {
  Vehicle model = published_vehicle();
  known_to(0.05, {"kT", "kQ", "km", "Jxx", "Jyy", "Jzz"}, model);
  known_to(0.01, {"m"}, model);
  return model;
}

Result compared(const Vehicle& real, const Vehicle& simulated) {
  const std::vector<FlightLog> flown{flight_of(real, 3)}, computed{flight_of(simulated, 4)};
  return compare_flights(stated(), flown, computed);
}

Vehicle with_drag(Vehicle vehicle) {
  vehicle.parameters["rotor_drag.kd"] = {6e-5, {}};
  return vehicle;
}

TEST(Comparison, WhatBothHaveIsNoDifference) {
  const Result found = compared(with_drag(stated()), with_drag(stated()));
  EXPECT_EQ(found.extra["verdict"]["status"], "none") << found.verdict;
  EXPECT_TRUE(found.extra["differences"].empty());
}

TEST(Comparison, DragThatTheSimulatorLacksIsTheDifference) {
  const Result found = compared(with_drag(stated()), stated());
  EXPECT_EQ(found.extra["verdict"]["effects"], nlohmann::ordered_json({"rotor_drag"})) << found.verdict;
  ASSERT_EQ(found.extra["differences"].size(), 1U);
  const auto& kd = found.extra["differences"][0];
  EXPECT_EQ(kd["name"], "rotor_drag.kd");
  EXPECT_LT(kd["ci95"][0].get<double>(), 6e-5);
  EXPECT_GT(kd["ci95"][1].get<double>(), 6e-5);
}

}  // namespace
}  // namespace ident
