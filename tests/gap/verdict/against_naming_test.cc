// The rules against naming a cause, one by one, on searches made by hand.
#include <gtest/gtest.h>

#include "support/verdict_case.h"

namespace ident {
namespace {

using Names = std::vector<std::string>;
using Case = VerdictCase;

TEST(AgainstNaming, WhatARegressionStillPredictsMakesItUnknownByItsShareOfWhatIsExplained) {
  Case c({"rotor_drag"}, {"rotor_drag"});
  c.weighs({0}, 1.0);
  c.rival.gain[0] = 100.0;  // a tenth of what the cause explains
  EXPECT_EQ(c.judged().status, "identified");
  c.rival.gain[0] = 200.0;
  const Judged left = c.judged();
  EXPECT_EQ(left.status, "unknown");
  EXPECT_TRUE(left.effects.empty());
  EXPECT_EQ(left.confused_with, Names{"rotor_drag"});
  Case exact({"rotor_tilt"}, {"rotor_tilt"});  // geometry leaves nothing
  exact.weighs({0}, 1.0);
  exact.rival.gain[0] = 55.0;
  EXPECT_EQ(exact.judged().status, "identified");
  exact.rival.gain[0] = 65.0;
  EXPECT_EQ(exact.judged().status, "unknown");
  exact.rival.gain[0] = 50.0;
  exact.search.alone[0].gain = 40.0;  // the regression sees more than the cause does
  EXPECT_EQ(exact.judged().status, "unknown");
}

// Rounding and what smoothing leaves show beside a cause that is huge; another cause in its place leaves
// more.
TEST(AgainstNaming, AFiftiethOfAHugeCauseMayBeLeft) {
  Case huge({"rotor_tilt", "rotor_mismatch"}, {"rotor_tilt"});
  huge.weighs({0}, 1.0);
  huge.search.alone[0].gain = 250000.0;
  huge.rival.gain[0] = 90.0;
  EXPECT_EQ(huge.judged().status, "identified");
  huge.rival.gain[0] = 110.0;
  EXPECT_EQ(huge.judged().status, "unknown");
  Case two({"rotor_tilt", "rotor_mismatch"}, {"rotor_tilt", "rotor_mismatch"});
  two.weighs({0, 1}, 1.0);
  two.search.alone[0].gain = 250000.0;
  two.rival.gain[0] = 90.0;
  EXPECT_EQ(two.judged().status, "unknown");
}

TEST(AgainstNaming, AGapThatMostlyRemainsIsUnknownAndOneThatRemainsInPartIsSaidSo) {
  Case c({"rotor_drag"}, {"rotor_drag"});
  c.weighs({0}, 1.0);
  c.closes({0.5, 0.7}, 0.6);
  const Judged part = c.judged();
  EXPECT_EQ(part.status, "identified");
  EXPECT_NEAR(part.remaining, 0.4, 1e-12);
  EXPECT_NE(part.sentence.find("40 %"), std::string::npos) << part.sentence;
  c.closes({0.1, 0.9}, 0.4);  // gusts may hide it
  EXPECT_EQ(c.judged().status, "identified");
  c.closes({0.1, 0.6}, 0.4);
  c.gap.after = 1.1 * c.gap.floor;  // as little as a floor is known to
  EXPECT_EQ(c.judged().status, "identified");
  c.gap.after = 1.2 * c.gap.floor;
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(AgainstNaming, AContradictedBenchValueMakesItUnknownUnlessItIsTheCause) {
  Case c({"rotor_tilt", "parameter:kT"}, {"rotor_tilt"});
  c.weighs({0}, 1.0);
  c.contradicts_kT(6.0);
  const Judged against = c.judged();
  EXPECT_EQ(against.status, "unknown");
  EXPECT_NE(against.sentence.find("kT"), std::string::npos) << against.sentence;
  c.search.best.adopted.push_back({"parameter:kT"});
  c.search.sets = {{{0, 1}, 0.0, 1.0}};
  EXPECT_EQ(c.judged().status, "identified");
}

TEST(AgainstNaming, CausesThatMoveMassesAreNotNamedWhereAPayloadWasNotTried) {
  Case c({"rotor_mismatch", "cg_offset", "products_of_inertia", "payload"},
         {"cg_offset", "products_of_inertia"});
  c.weighs({1, 2}, 1.0);
  EXPECT_EQ(c.judged().status, "identified");
  c.search.problem.candidates.pop_back();
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.best.adopted.pop_back();
  c.search.sets = {{{1}, 0.0, 1.0}};
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.best.adopted[0].name = c.search.problem.candidates[1].name = "parameter:Jxx";
  EXPECT_EQ(c.judged().status, "identified");
}

// Ten parts of a flight that disagree on the size of the first cause, and agree on that of the others.
void disagrees(Case& c) {
  c.search.alone[0].gain = 100;
  c.search.form.scores = Eigen::MatrixXd::Zero(3, 10);
  for (int part = 0; part < 10; ++part) {
    const double sign = part % 2 == 0 ? 1.0 : -1.0;
    c.search.form.scores.col(part) = sign * Eigen::Vector3d(4.0, 1.0, 1.0);
    c.search.form.information.push_back(Eigen::Matrix3d::Identity());
  }
  for (int i = 0; i < 3; ++i) c.search.problem.candidates[static_cast<std::size_t>(i)].directions = {i};
  c.weighs({0}, 1.0);
}

TEST(AgainstNaming, AConstantOfTheVehicleThatChangesInFlightIsNotTheCause) {
  Case geometry({"rotor_tilt", "rotor_drag", "imu_bias"}, {"rotor_tilt"});
  disagrees(geometry);
  EXPECT_EQ(geometry.judged().status, "unknown");
  Case air({"rotor_drag", "rotor_tilt", "imu_bias"}, {"rotor_drag"});  // an equation that air follows nearly
  disagrees(air);
  EXPECT_EQ(air.judged().status, "identified");
  Case strong({"rotor_tilt", "rotor_drag", "imu_bias"}, {"rotor_tilt"});
  disagrees(strong);
  strong.search.alone[0].gain = 1e5;  // it changes by a hundredth of itself
  EXPECT_EQ(strong.judged().status, "identified");
  Case motor({"motor_asymmetry", "rotor_drag", "imu_bias"}, {"motor_asymmetry"});
  disagrees(motor);  // by less than half of itself: motors are what they are only nearly
  EXPECT_EQ(motor.judged().status, "identified");
  motor.search.alone[0].gain = 20;
  EXPECT_EQ(motor.judged().status, "unknown");
  geometry.search.form.scores.bottomRows(2) *= 4;  // what the colour of the residuals does to all
  EXPECT_EQ(geometry.judged().status, "identified");
}

// Air has never quite the catalogue's form, and a strong cause shows that as scatter of its value.
TEST(AgainstNaming, BesideAStrongCauseOfTheAirMoreIsLeftToARegression) {
  Case c({"rotor_drag", "rotor_tilt", "imu_bias"}, {"rotor_drag"});
  disagrees(c);
  c.search.alone[0].gain = 1000;
  c.rival.gain[0] = 300.0;
  EXPECT_EQ(c.judged().status, "identified");
  c.rival.gain[0] = 600.0;
  EXPECT_EQ(c.judged().status, "identified");
  c.rival.gain[0] = 1200.0;
  EXPECT_EQ(c.judged().status, "unknown");
  c.rival.gain[0] = 300.0;
  c.search.form.scores.setZero();  // as much without scatter
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(AgainstNaming, BesideSeveralCausesLessIsLeftToARegressionThanBesideOne) {
  Case c({"rotor_drag", "rotor_tilt", "imu_bias"}, {"rotor_drag", "imu_bias"});
  disagrees(c);
  c.search.alone[0].gain = 1000;
  c.rival.gain[0] = 600.0;
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(AgainstNaming, FlappingIsNotNamedWhereTheDragThatComesWithItWasNotTried) {
  Case c({"blade_flapping", "rotor_drag"}, {"blade_flapping"});
  c.weighs({0}, 1.0);
  EXPECT_EQ(c.judged().status, "identified");
  c.search.problem.candidates.pop_back();
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(AgainstNaming, ACauseOfTheDriveMayLeaveAThirdOfWhatItGainsAndOtherCausesLendItNothing) {
  Case c({"battery_sag", "rotor_tilt"}, {"battery_sag"});
  c.weighs({0}, 1.0);
  c.rival.gain[2] = 300.0;
  EXPECT_EQ(c.judged().status, "identified");
  std::swap(c.rival.gain[0], c.rival.gain[2]);  // a thrust of another form pushes nothing forward
  EXPECT_EQ(c.judged().status, "unknown");
  c.rival.gain = {0, 0, 400.0, 0, 0, 0};
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.best.adopted.push_back({"rotor_tilt"});
  c.search.alone.push_back({"rotor_tilt", 500.0});
  c.search.sets = {{{0, 1}, 0.0, 1.0}};
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.alone[0].gain = 1200.0;
  EXPECT_EQ(c.judged().status, "identified");
}

TEST(AgainstNaming, ThreeWrongBenchValuesAtOnceAreNoAnswer) {
  Case c({"parameter:m", "parameter:kT", "parameter:Jxx"}, {"parameter:m", "parameter:kT"});
  for (int i = 0; i < 2; ++i) c.search.best.adopted[static_cast<std::size_t>(i)].parameter = i;
  c.weighs({0, 1}, 1.0);
  EXPECT_EQ(c.judged().status, "identified");
  Candidate third{"parameter:Jxx"};
  third.parameter = 2;
  c.search.best.adopted.push_back(third);
  c.search.sets = {{{0, 1, 2}, 0.0, 1.0}};
  const Judged many = c.judged();
  EXPECT_EQ(many.status, "unknown");
  EXPECT_EQ(many.confused_with.size(), 3U);
}

TEST(AgainstNaming, APayloadBesideWhatItDoesItselfIsNoAnswer) {
  for (const char* own : {"cg_offset", "parameter:m"}) {
    Case c({"payload", own, "rotor_mismatch"}, {"payload", own});
    c.weighs({0, 1}, 1.0);
    EXPECT_EQ(c.judged().status, "unknown") << own;
  }
}

TEST(AgainstNaming, AShiftedCentreOfGravityIsNotNamedWhereAWeakRotorWasNotTried) {
  Case c({"payload", "cg_offset", "rotor_mismatch"}, {"cg_offset"});
  c.weighs({1}, 1.0);
  EXPECT_EQ(c.judged().status, "identified");
  c.search.problem.candidates.pop_back();
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(AgainstNaming, ACauseOfWhichOneChannelAsksForAnotherSizeIsNotNamed) {
  Case c({"motor_asymmetry"}, {"motor_asymmetry"});
  c.weighs({0}, 1.0);
  c.search.asked = {{{"roll", 0.4, 0.07, 0.1}, {"rotor speeds", -0.05, 0.02, 0.9}}};
  EXPECT_NEAR(std::pow(0.4 / 0.07, 2) + std::pow(0.05 / 0.02, 2), 38.9, 0.1);
  EXPECT_EQ(c.judged().status, "identified");
  c.search.asked[0][0].std = 0.065;
  const Judged other = c.judged();
  EXPECT_EQ(other.status, "unknown");
  EXPECT_NE(other.sentence.find("roll asks"), std::string::npos) << other.sentence;
  c.search.asked[0][0].weight = 0.005;  // it knows next to nothing of that size
  EXPECT_EQ(c.judged().status, "identified");
  c.search.asked[0][0] = {"roll", 0.2, 0.03, 0.1};  // by a fifth of itself
  EXPECT_EQ(c.judged().status, "identified");
  c.search.asked[0][0] = {"roll", 0.4, 0.2, 0.1};  // it is rotor speeds that disagree, by little
  c.search.asked[0][1].std = 0.005;
  EXPECT_EQ(c.judged().status, "identified");
  c.search.asked[0][0] = {"roll", 0.4, 0.05, 0.1};
  c.search.best.adopted[0].name = c.search.problem.candidates[0].name =
      "ground_effect";  // of nearly this form
  EXPECT_EQ(c.judged().status, "identified");
}

TEST(AgainstNaming, AirHasItsFinerPointsButNoDragOfTwoSizes) {
  Case c({"rotor_drag"}, {"rotor_drag"});
  c.weighs({0}, 1.0);
  c.search.asked = {{{"level", 0.3, 0.13, 0.7}, {"roll", -0.45, 0.05, 0.1}}};
  EXPECT_EQ(c.judged().status, "identified");
  c.search.asked[0][1].change = -0.6;
  const Judged quadratic = c.judged();
  EXPECT_EQ(quadratic.status, "unknown");
  EXPECT_NE(quadratic.sentence.find("roll asks"), std::string::npos) << quadratic.sentence;
  for (const char* loose : {"ground_effect", "battery_sag", "thrust_curve"}) {
    c.search.best.adopted[0].name = c.search.problem.candidates[0].name = loose;
    EXPECT_EQ(c.judged().status, "identified") << loose;
  }
}

TEST(AgainstNaming, AWeakCauseBesideWhatSwingsOrStrikesIsNotNamed) {
  Case c({"thrust_curve"}, {"thrust_curve"});
  c.weighs({0}, 1.0);
  c.jumps = {{"Mx", 0, 10, 10, 14.0, 20.0}};
  EXPECT_EQ(c.judged().status, "identified");
  c.search.alone[0].gain = 50.0;
  EXPECT_EQ(c.judged().status, "unknown");
  c.jumps[0].count = 2;
  EXPECT_EQ(c.judged().status, "identified");
  c.lines = {{"az", 7.0, 6.0, 0.04}};
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.alone[0].gain = 500.0;  // what a propeller out of balance left to others
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.alone[0].gain = 2000.0;
  EXPECT_EQ(c.judged().status, "identified");
}

TEST(AgainstNaming, TheSameIllOfTwoRotorsIsNotNamed) {
  Case c({"rotor_mismatch", "rotor_mismatch", "rotor_tilt"}, {"rotor_mismatch"});
  c.search.best.adopted[0].rotor = 0;
  c.weighs({0}, 1.0);
  EXPECT_EQ(c.judged().status, "identified");
  Candidate other{"rotor_mismatch"};
  other.rotor = 2;
  c.search.best.adopted.push_back(other);
  const Judged twice = c.judged();
  EXPECT_EQ(twice.status, "unknown");
  EXPECT_EQ(twice.confused_with, Names{"rotor_mismatch"});
  c.search.best.adopted[1].name = "rotor_tilt";
  EXPECT_EQ(c.judged().status, "identified");
}

}  // namespace
}  // namespace ident
