// Which cause is looked at next, on quadratic forms made by hand.
#include "ident/gap/search/next_cause.h"

#include <gtest/gtest.h>

#include "support/standing_by_hand.h"

namespace ident {
namespace {

const auto kAny = [](int) { return false; };

// A battery that by the form falls faster than any does, and a bias that passes.
Standing a_battery_and_a_bias(double information) {
  Standing at =
      standing_by_hand({"m", "battery_sag.rate", "imu_bias.ax"}, Eigen::VectorXd{{1.0, information, 1e4}},
                       Eigen::VectorXd{{0.0, 200.0, 0.1}});
  at.problem.constants[1].scale = 0.0005;  // typical of a battery: by the form it falls by a tenth a second
  at.problem.candidates = {{"battery_sag", {1}}, {"imu_bias", {2}}};
  return at;
}

TEST(NextCause, OneBeyondItsRangeIsTriedWhereItGainsFarMoreThanAnyOther) {
  const Standing strong = a_battery_and_a_bias(2.25);  // gains 90000, the bias 100
  const NextCause next = next_cause(strong, kAny, {});
  EXPECT_EQ(next.uneven.candidate, 0);
  EXPECT_TRUE(next.uneven.beyond);
  EXPECT_EQ(next.best.candidate, 1);
  EXPECT_FALSE(further(strong, {}, 0).passes());
  EXPECT_EQ(next_cause(a_battery_and_a_bias(0.0225), kAny, {}).uneven.candidate, 1);
}

TEST(NextCause, WhatWasTriedMayStillBeFoundAndWhatIsBarredMayNot) {
  const Standing at = a_battery_and_a_bias(2.25);
  const NextCause tried = next_cause(at, kAny, {at.problem.candidates[0], at.problem.candidates[1]});
  EXPECT_EQ(tried.uneven.candidate, -1);
  EXPECT_EQ(tried.best.candidate, 1);
  const NextCause barred = next_cause(at, [](int c) { return c == 1; }, {});
  EXPECT_EQ(barred.best.candidate, -1);
  EXPECT_EQ(barred.uneven.candidate, 0);
}

TEST(NextCause, OfThoseThatPassTheOneWithMostEvidenceIsBest) {
  Standing at = standing_by_hand({"m", "imu_bias.ax", "imu_lever_arm.x"}, Eigen::VectorXd{{1.0, 1e4, 2e4}},
                                 Eigen::VectorXd{{0.0, 0.1, 0.1}});
  at.problem.candidates = {{"imu_bias", {1}}, {"imu_lever_arm", {2}}};
  EXPECT_EQ(next_cause(at, kAny, {}).best.candidate, 1);
  at.have = {1};
  EXPECT_EQ(next_cause(at, kAny, {}).best.candidate, 0);
}

Further gaining(double gain, double stretch) {
  Further f;
  f.gain = gain * stretch, f.stretch = stretch;
  return f;
}

TEST(NextCause, AThirdOneExplainsItsShareOrIsABenchValueWrongByTheSameEverywhere) {
  const Candidate wrong{"parameter:omega_m", {}, 3}, effect{"gyroscopic", {4}};
  EXPECT_TRUE(is_material(gaining(410, 1.0), effect, 2, 1e4));
  EXPECT_FALSE(is_material(gaining(390, 1.0), effect, 2, 1e4));
  EXPECT_TRUE(is_material(gaining(390, 1.0), wrong, 2, 1e4));
  EXPECT_FALSE(is_material(gaining(390, 2.0), wrong, 2, 1e4));
  EXPECT_FALSE(is_material(gaining(90, 1.0), wrong, 2, 1e4));
}

TEST(NextCause, WhatGainsLittleBesideSomethingVeryStrongIsItsForm) {
  const Candidate wrong{"parameter:omega_m", {}, 3}, effect{"thrust_curve", {4, 5}};
  const Candidate mounting{"imu_lever_arm", {4, 5, 6}};
  EXPECT_TRUE(is_material(gaining(55, 1.0), effect, 1, 1e4));
  EXPECT_FALSE(is_material(gaining(45, 1.0), effect, 1, 1e4));
  EXPECT_FALSE(is_material(gaining(240, 1.0), effect, 1, 1e6));
  EXPECT_TRUE(is_material(gaining(260, 1.0), effect, 1, 1e6));
  EXPECT_TRUE(is_material(gaining(45, 1.0), wrong, 1, 1e6));
  EXPECT_TRUE(is_material(gaining(45, 1.0), mounting, 1, 1e6));
  EXPECT_TRUE(is_material(gaining(45, 1.0), effect, 0, 0.0));
}

TEST(NextCause, ASecondOneThatChangesExplainsMoreThanNextToNothing) {
  const Candidate effect{"gyroscopic", {4}}, moves{"cg_offset", {5, 6, 7}};
  EXPECT_TRUE(is_material(gaining(90, 4.0), effect, 1, 1e4));
  EXPECT_FALSE(is_material(gaining(90, 6.0), effect, 1, 1e4));
  EXPECT_TRUE(is_material(gaining(110, 6.0), effect, 1, 1e4));
  EXPECT_TRUE(is_material(gaining(90, 6.0), moves, 1, 1e4));
}

}  // namespace
}  // namespace ident
