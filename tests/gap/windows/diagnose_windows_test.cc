// Causes from forces and moments along measured motion: their sizes, what stays silent, and real flights.
#include "ident/gap/diagnose_windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ident/io/vehicle/vehicle_read.h"
#include "support/known_quad.h"
#include "support/real_data.h"

namespace ident {
namespace {

using Names = std::vector<std::string>;
using testing::flight;
using testing::quad;

Vehicle in_air() {
  Vehicle v = quad(0.0);
  v.parameters["rotor_drag.kd"].value = 2e-5, v.parameters["axial_inflow.kz"].value = 3e-5;
  return v;
}

Vehicle as_stated(const Vehicle& truth) {
  Vehicle v = testing::known(truth);
  v.parameters.erase("rotor_drag.kd"), v.parameters.erase("axial_inflow.kz");
  return v;
}

WindowDiagnosis by_windows(const Vehicle& vehicle, FlightLog log) {
  const std::vector<FlightLog> logs{std::move(log)};
  Result result;
  const FlightEntry entry = enter_flight(vehicle, logs, result);
  const std::optional<LadderResult> ladder = climb_ladder(entry.record);
  std::optional<WindowDiagnosis> found =
      diagnose_windows(vehicle, logs, {}, entry, result, ladder ? found_by_ladder(*ladder) : std::nullopt);
  if (!found) throw std::runtime_error("nothing that windows tell");
  return *std::move(found);
}

bool names(const Diagnosis& found, const std::string& cause) {
  return std::ranges::find(found.verdict.effects, cause) != found.verdict.effects.end();
}

TEST(Windows, FindDragAndInflowWithSizesThatTheirDeviationsHold) {
  const Vehicle truth = in_air();
  int held = 0, asked = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const WindowDiagnosis found = by_windows(as_stated(truth), flight(truth, 100, seed));
    for (const char* cause : {"rotor_drag", "axial_inflow"})
      EXPECT_TRUE(names(found, cause)) << cause << ", seed " << seed << ": " << found.verdict.sentence;
    for (const char* name : {"rotor_drag.kd", "axial_inflow.kz", "kT"}) {
      const Known& c = found.adopted.parameters.at(name);
      const double apart = std::abs(c.value - truth.value(name));
      EXPECT_LT(apart, 5 * *c.std) << name << ", seed " << seed;
      held += apart < 1.96 * *c.std, ++asked;
    }
  }
  EXPECT_GE(held, asked - 3) << "of " << asked << " intervals of 95 %";
}

TEST(Windows, NameNothingWhereNothingIsMissing) {
  const Vehicle truth = quad(0.0);
  for (std::uint64_t seed = 11; seed <= 16; ++seed) {
    const WindowDiagnosis found = by_windows(testing::known(truth), flight(truth, 100, seed));
    EXPECT_TRUE(found.verdict.effects.empty()) << "seed " << seed << ": " << found.verdict.sentence;
  }
}

// Published inertia and arms of real vehicles are off by a third and more.
TEST(Windows, AWrongInertiaBendsNothingThatForcesTell) {
  const Vehicle truth = in_air();
  Vehicle stated = as_stated(truth);
  for (const char* name : {"Jxx", "Jyy"})
    stated.parameters[name] = {0.5 * truth.value(name), 0.05 * truth.value(name)};
  const WindowDiagnosis found = by_windows(stated, flight(truth, 100, 3));
  EXPECT_TRUE(names(found, "rotor_drag")) << found.verdict.sentence;
  for (const char* name : {"rotor_drag.kd", "axial_inflow.kz"})
    EXPECT_NEAR(found.adopted.parameters.at(name).value / truth.value(name), 1.0, 0.1) << name;
  EXPECT_NEAR(found.adopted.parameters.at("m").value / truth.value("m"), 1.0, 0.01);
}

// Where commands and speeds were both logged, a wrong motor is a cause that was measured itself.
TEST(Windows, AMotorThatSpeedsContradictIsNamedAndTheRestIsFoundBesideIt) {
  const Vehicle truth = in_air();
  Vehicle stated = as_stated(truth);
  stated.parameters["km"] = {0.8 * truth.value("km"), 0.03 * truth.value("km")};
  const WindowDiagnosis found = by_windows(stated, flight(truth, 100, 3));
  EXPECT_TRUE(names(found, "parameter:km")) << found.verdict.sentence;
  EXPECT_TRUE(names(found, "rotor_drag")) << found.verdict.sentence;
  EXPECT_NEAR(found.adopted.parameters.at("km").value / truth.value("km"), 1.0, 0.01);
  const auto& speeds = found.result.extra["gap"]["rotor_speeds"]["horizons"][1];
  EXPECT_LT(speeds["after"].get<double>(), 0.3 * speeds["before"].get<double>());
}

// It is of the model, and no cause: a weak rotor turns the vehicle as well.
TEST(Windows, WhatMakesALastingMomentIsOfTheModelAndNotNamed) {
  Vehicle truth = quad(0.0);
  const Vehicle stated = testing::known(truth);
  truth.parameters["cg_offset.x"].value = 2e-3;
  const WindowDiagnosis found = by_windows(stated, flight(truth, 100, 4));
  ASSERT_TRUE(found.adopted.parameters.contains("cg_offset.x"));
  EXPECT_NEAR(found.adopted.parameters.at("cg_offset.x").value, 2e-3, 3e-4);
  EXPECT_FALSE(names(found, "cg_offset")) << found.verdict.sentence;
  const auto& rates = found.result.extra["gap"]["moments"]["horizons"][0];
  EXPECT_LT(rates["after"].get<double>(), 0.5 * rates["before"].get<double>());
}

// What an engineer's regression finds on these flights is in EXPERT.md beside them.
class RealWindows : public ::testing::Test {
 protected:
  static Diagnosis of(const std::string& folder, const std::string& name) {
    const Vehicle vehicle = read_vehicle(folder + "/vehicle.yaml");
    const std::vector<FlightLog> logs{read_flight_log(folder + "/" + name + ".csv", vehicle, {})};
    return diagnose_gap(vehicle, logs);
  }
};

TEST_F(RealWindows, ARacingQuadrotorHasDragInflowAndFlapping) {
  IDENT_NEEDS_REAL_DATA(data);
  const Diagnosis found = of(data + "/flight/neurobem", "flight_a");
  for (const char* cause : {"rotor_drag", "axial_inflow", "blade_flapping"})
    EXPECT_TRUE(names(found, cause)) << cause << ": " << found.verdict.sentence;
  const auto within_30_percent = [&](const char* name, double expert) {
    EXPECT_NEAR(found.adopted.parameters.at(name).value / expert, 1.0, 0.3) << name;
  };
  within_30_percent("rotor_drag.kd", 4.7e-5);
  within_30_percent("axial_inflow.kz", 9.3e-5);
  within_30_percent("blade_flapping.kf", 3.1e-6);
  EXPECT_NEAR(found.adopted.parameters.at("kT").value / 1.54e-6, 1.0, 0.05);
}

TEST_F(RealWindows, BothFlightsAboveTheGroundShowIt) {
  IDENT_NEEDS_REAL_DATA(data);
  for (const char* name : {"ground_a", "ground_b"}) {
    const Diagnosis found = of(data + "/flight/neuralswarm", name);
    EXPECT_TRUE(names(found, "ground_effect")) << name << ": " << found.verdict.sentence;
  }
}

TEST_F(RealWindows, ACrazyflieHasABatteryAndDrag) {
  IDENT_NEEDS_REAL_DATA(data);
  const Vehicle vehicle = read_vehicle(std::string(IDENT_SOURCE_DIR) + "/data/published/crazyflie_21.yaml");
  const LogMap map = read_log_map(std::string(IDENT_SOURCE_DIR) + "/data/maps/nanobench_crazyflie.yaml");
  const std::string name = data + "/flight/nanobench/B3_figure8_fast_rep1.csv";
  const std::vector<FlightLog> logs{read_flight_log(name, vehicle, map)};
  const Diagnosis found = diagnose_gap(vehicle, logs);
  EXPECT_TRUE(names(found, "battery_sag")) << found.verdict.sentence;
  EXPECT_TRUE(names(found, "rotor_drag")) << found.verdict.sentence;
  EXPECT_NEAR(found.adopted.parameters.at("rotor_drag.kd").value, 2e-6, 6e-7);
}

}  // namespace
}  // namespace ident
