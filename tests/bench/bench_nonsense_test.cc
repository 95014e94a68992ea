// Bench files that are read without an error and yet wrong: each is refused, or named in a warning, never a
// plausible number in silence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ident/bench/inertia/trifilar_inertia.h"
#include "ident/bench/motor/motor_step.h"
#include "ident/bench/thrust/thrust_sweep.h"
#include "ident/core/error.h"
#include "support/bench_campaign.h"
#include "support/thrust_tables.h"

namespace ident {
namespace {

using bench::SweepTable;
using bench::values;

NumberTable scaled(NumberTable table, const std::string& column, double factor) {
  for (double& v : values(table, column)) v *= factor;
  return table;
}

std::string refusal(const NumberTable& table) {
  try {
    estimate_thrust({table});
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

TEST(BenchNonsense, AGoodSweepIsNotSuspected) {
  const Result result = estimate_thrust({SweepTable().table()}, {.radius = 0.1});
  for (const char* code : {"implausible_thrust", "implausible_torque_ratio", "figure_of_merit",
                           "not_identifiable", "few_speeds", "command_reversed"})
    EXPECT_FALSE(result.has_warning(code)) << code;
}

TEST(BenchNonsense, ThrustAndTorqueInEachOthersColumnAreNamed) {
  NumberTable table = SweepTable().table();
  std::swap(values(table, "thrust"), values(table, "torque"));
  EXPECT_TRUE(estimate_thrust({table}).has_warning("implausible_torque_ratio"));
}

TEST(BenchNonsense, UnitsOfForceThatAreWrongAreNamed) {
  const NumberTable good = SweepTable().table();
  EXPECT_TRUE(
      estimate_thrust({scaled(good, "thrust", 102.0)}).has_warning("implausible_torque_ratio"));  // gf
  EXPECT_TRUE(
      estimate_thrust({scaled(good, "torque", 100.0)}).has_warning("implausible_torque_ratio"));  // N cm
  EXPECT_TRUE(estimate_thrust({scaled(good, "torque", 0.01)}).has_warning("implausible_torque_ratio"));
  EXPECT_TRUE(
      estimate_thrust({scaled(good, "thrust", 102.0)}, {.radius = 0.1}).has_warning("implausible_thrust"));
}

TEST(BenchNonsense, RevolutionsPerMinuteAsRadiansAreNamedWhereTheRadiusIsKnown) {
  const NumberTable table = scaled(SweepTable().table(), "omega", 30 / M_PI);
  EXPECT_TRUE(estimate_thrust({table}, {.radius = 0.1}).has_warning("implausible_thrust"));
}

TEST(BenchNonsense, ThrustThatIsTheSameInEveryRowIsRefused) {
  for (const double thrust : {0.0, 1.0}) {
    NumberTable table = SweepTable().table();
    std::ranges::fill(values(table, "thrust"), thrust);
    EXPECT_NE(refusal(table).find("thrust is the same in every row"), std::string::npos) << refusal(table);
  }
}

TEST(BenchNonsense, OneSpeedWithoutRestIsRefused) {
  SweepTable sweep;
  sweep.at_rest = 0;
  NumberTable table = sweep.table();
  for (double& v : values(table, "omega")) v = 800.0;
  EXPECT_NE(refusal(table).find("one rotor speed"), std::string::npos) << refusal(table);
}

TEST(BenchNonsense, TwoSpeedsAreFittedWithAWarning) {
  SweepTable sweep;
  sweep.set_points = 2, sweep.repeats = 8, sweep.at_rest = 0;
  const Result result = estimate_thrust({sweep.table()});
  EXPECT_TRUE(result.has_warning("few_speeds"));
  EXPECT_NEAR(result.find("kT")->value / 6e-6, 1.0, 0.03);
}

TEST(BenchNonsense, ForcesThatAreNoiseAloneAreNotIdentifiable) {
  SweepTable sweep;
  NumberTable table = sweep.table();
  bench::Random random(7);
  for (double& v : values(table, "thrust")) v = 0.02 * random.normal();
  const Result result = estimate_thrust({table});
  EXPECT_FALSE(result.find("kT")->identifiable);
  EXPECT_TRUE(result.has_warning("not_identifiable"));
}

TEST(BenchNonsense, ACommandThatFallsWithTheSpeedGivesNoCurve) {
  NumberTable table = SweepTable().table();
  for (double& v : values(table, "delta")) v = 1.0 - v;
  const Result result = estimate_thrust({table});
  EXPECT_TRUE(result.has_warning("command_reversed"));
  EXPECT_EQ(result.find("km"), nullptr);
}

NumberTable steps() {
  bench::Random random(1);
  const bench::BenchVehicle vehicle = bench::random_vehicle(random);
  return bench::motor_steps(vehicle, random, {.noise = 0.002 * vehicle.km}).table;
}

TEST(BenchNonsense, RowsTooFarApartForAMotorAreRefused) {
  EXPECT_THROW(estimate_motor({scaled(steps(), "t", 1000.0)}), DataError);  // ms
}

TEST(BenchNonsense, AFastMotorIsFoundAndItsTimeQuestioned) {
  const Result slow = estimate_motor({steps()}),
               fast = estimate_motor({scaled(steps(), "t", 1.0 / 60)});  // min
  EXPECT_NEAR(fast.find("omega_m")->value / slow.find("omega_m")->value, 60.0, 6.0);
  EXPECT_EQ(fast.has_warning("implausible_motor"), fast.find("omega_m")->value > 500.0);
}

TEST(BenchNonsense, ASpeedThatDoesNotFollowIsRefused) {
  NumberTable still = steps(), noise = steps();
  std::ranges::fill(values(still, "omega"), 500.0);
  bench::Random random(3);
  for (double& v : values(noise, "omega")) v = 500.0 + random.normal();
  EXPECT_THROW(estimate_motor({still}), DataError);
  EXPECT_THROW(estimate_motor({noise}), DataError);
}

NumberTable swings(double period, double radius, double length) {
  bench::Random random(5);
  const bench::BenchVehicle vehicle = bench::random_vehicle(random);
  NumberTable table = bench::pendulum(vehicle, random, 5, {}).table;
  for (double& v : values(table, "period")) v *= period;
  for (double& v : values(table, "radius")) v *= radius;
  for (double& v : values(table, "length")) v *= length;
  return table;
}

TEST(BenchNonsense, PeriodsOfTenSwingsAndSwappedMeasuresAreNamed) {
  EXPECT_FALSE(estimate_inertia({swings(1, 1, 1)}).has_warning("implausible_inertia"));
  EXPECT_TRUE(estimate_inertia({swings(10, 1, 1)}).has_warning("implausible_inertia"));
  NumberTable swapped = swings(1, 1, 1);
  std::swap(values(swapped, "radius"), values(swapped, "length"));
  EXPECT_TRUE(estimate_inertia({swapped}).has_warning("implausible_inertia"));
}

}  // namespace
}  // namespace ident
