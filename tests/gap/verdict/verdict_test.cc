// What a verdict says, on searches made by hand.
#include <gtest/gtest.h>

#include "support/verdict_case.h"

namespace ident {
namespace {

using Names = std::vector<std::string>;
using Case = VerdictCase;

TEST(Verdict, WhatIsHardlyThereBesideAStrongCauseIsNotNamed) {
  Case c({"motor_asymmetry", "sensor_delay"}, {"motor_asymmetry", "sensor_delay"});
  c.weighs({0}, 0.95);
  c.weighs({0, 1}, 0.05);
  EXPECT_EQ(c.judged().effects, Names{"motor_asymmetry"});
  EXPECT_NE(c.judged().sentence.find("holds sensor_delay as well, which is hardly there"), std::string::npos)
      << c.judged().sentence;
  c.search.sets.clear();
  c.weighs({0}, 0.6);
  c.weighs({0, 1}, 0.4);
  EXPECT_EQ(c.judged().effects, (Names{"motor_asymmetry", "sensor_delay"}));
}

TEST(Verdict, ACurveThatBendsLessThanStandsScatterIsTheFormOfWhatItStandsBeside) {
  Case c({"wind", "thrust_curve"}, {"wind", "thrust_curve"});
  c.weighs({0, 1}, 1.0);
  c.search.alone[1].gain = 80;
  Parameter bend, offset;
  bend.name = "thrust_curve.c", bend.value = -0.01, offset.name = "thrust_curve.offset", offset.value = 0.004;
  c.fitted = {bend, offset};
  EXPECT_EQ(c.judged().effects, Names{"wind"});
  c.search.alone[1].gain = 500;  // however little, it is plain
  EXPECT_EQ(c.judged().effects, (Names{"wind", "thrust_curve"}));
  c.search.alone[1].gain = 80, c.fitted[1].value = 0.03;
  EXPECT_EQ(c.judged().effects, (Names{"wind", "thrust_curve"}));
  Case alone({"thrust_curve"}, {"thrust_curve"});
  alone.weighs({0}, 1.0);
  alone.search.alone[0].gain = 80, alone.fitted = {bend, offset};
  EXPECT_EQ(alone.judged().effects, Names{"thrust_curve"});
}

TEST(Verdict, WithoutACauseThatCouldBeTriedTheLikelyOnesAreTold) {
  Case c({"rotor_drag", "wind", "payload"}, {});
  c.weighs({}, 0.5), c.weighs({1}, 0.3), c.weighs({0}, 0.18), c.weighs({2}, 0.02);
  EXPECT_TRUE(c.judged().confused_with.empty());
  c.jumps.push_back({"Mx", 0, 5, 5, 8.0, 3.0});
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "unknown");
  EXPECT_TRUE(seen.effects.empty());
  EXPECT_EQ(seen.confused_with, (Names{"wind", "rotor_drag"}));
}

TEST(Verdict, ACauseBesideTheOneFoundIsNoRivalAndOneInItsPlaceIs) {
  Case c({"rotor_drag", "cg_offset", "payload", "rotor_mismatch"}, {"cg_offset"});
  c.weighs({1}, 0.3);
  c.weighs({0, 1}, 0.7);
  const Judged beside = c.judged();
  EXPECT_EQ(beside.status, "identified");
  EXPECT_EQ(beside.effects, Names{"cg_offset"});
  EXPECT_TRUE(beside.confused_with.empty());
  c.search.sets.clear();
  c.weighs({1}, 0.6);
  c.weighs({2}, 0.4);
  const Judged instead = c.judged();
  EXPECT_EQ(instead.status, "ambiguous");
  EXPECT_EQ(instead.effects, Names{"cg_offset"});
  EXPECT_EQ(instead.confused_with, Names{"payload"});
}

TEST(Verdict, APayloadWhoseMassIsNotSeenIsAShiftedCentreOfGravityAsWell) {
  Case c({"payload", "cg_offset"}, {"payload"});
  c.weighs({0}, 0.97), c.weighs({1}, 0.03);
  Parameter mass;
  mass.name = "payload.m", mass.value = 0.06, mass.std = 0.01;
  c.fitted = {mass};
  EXPECT_EQ(c.judged().status, "identified");
  c.fitted[0].std = 0.02;
  const Judged either = c.judged();
  EXPECT_EQ(either.status, "ambiguous");
  EXPECT_EQ(either.effects, Names{"payload"});
  EXPECT_EQ(either.confused_with, Names{"cg_offset"});
  c.search.sets[1].probability = 1e-3;  // what it adds to the moments of inertia shows it
  EXPECT_EQ(c.judged().status, "identified");
  c.search.sets[1].probability = 0.03;
  c.search.best.adopted.push_back({"rotor_drag"});  // its place does what the other cause leaves
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.best.adopted.pop_back();
  c.search.problem.candidates.pop_back();
  EXPECT_EQ(c.judged().status, "unknown");
  c.fitted[0].value = -0.06, c.fitted[0].std = 0.01;  // far from none on the wrong side
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(Verdict, AShiftedCentreOfGravityMayBeALightPayloadThoughThatIsLessProbable) {
  Case c({"cg_offset", "payload", "rotor_mismatch"}, {"cg_offset"});
  c.weighs({0}, 0.92);
  c.weighs({1}, 0.08);
  EXPECT_EQ(c.judged().status, "ambiguous");
  EXPECT_EQ(c.judged().confused_with, Names{"payload"});
  c.search.sets[1].members = {2};
  EXPECT_EQ(c.judged().status, "identified");
  c.search.sets[1] = {{1}, 0.0, 0.04};
  EXPECT_EQ(c.judged().status, "identified");
}

TEST(Verdict, WithoutFlightToTryThemOnNoCauseIsNamed) {
  Case c({"rotor_drag"}, {"rotor_drag"});
  c.weighs({0}, 1.0);
  c.gap = {};
  EXPECT_EQ(c.judged().status, "identified") << "nothing could be predicted, of flight that there was";
  c.gap.held_out = false;
  const Judged nearest = c.judged();
  EXPECT_EQ(nearest.status, "unknown");
  EXPECT_TRUE(nearest.refused);
  EXPECT_EQ(nearest.confused_with, Names{"rotor_drag"});
  EXPECT_NE(nearest.sentence.find("too short"), std::string::npos) << nearest.sentence;
  Case none({"rotor_drag"}, {});
  none.gap = {.held_out = false};
  EXPECT_EQ(none.judged().status, "none");
  EXPECT_NE(none.judged().sentence.find("too short"), std::string::npos) << none.judged().sentence;
}

TEST(Verdict, MoreThanThreeNamesAreNoAnswer) {
  Case c({"rotor_drag", "parasitic_drag", "blade_flapping", "wind"}, {"rotor_drag"});
  c.weighs({0}, 0.4);
  c.weighs({1}, 0.2);
  c.weighs({2}, 0.2);
  const Judged three = c.judged();
  EXPECT_EQ(three.status, "ambiguous");
  EXPECT_EQ(three.confused_with, (Names{"parasitic_drag", "blade_flapping"}));
  c.weighs({3}, 0.2);
  const Judged four = c.judged();
  EXPECT_EQ(four.status, "unknown");
  EXPECT_TRUE(four.effects.empty());
  EXPECT_EQ(four.confused_with.size(), 4U);
}

TEST(Verdict, ALagThatNoPhysicsMakesIsNamedWhateverIsBesideIt) {
  Case c({"parameter:omega_m", "rotor_tilt", "gyroscopic", "battery_sag"},
         {"parameter:omega_m", "rotor_tilt", "gyroscopic", "battery_sag"});
  c.weighs({0, 1, 2, 3}, 1.0);
  Parameter omega_m, zeta_m;
  omega_m.name = "omega_m", omega_m.value = 28, omega_m.std = 1, omega_m.prior_value = 300;
  zeta_m.name = "zeta_m", zeta_m.value = 1;
  c.fitted = {omega_m, zeta_m};
  c.closes({-0.5, 1.0}, 0.3);
  const Judged named = c.judged();
  EXPECT_EQ(named.status, "identified");
  EXPECT_EQ(named.effects, Names{"parameter:omega_m"});
  EXPECT_NEAR(named.remaining, 0.7, 1e-12);
  EXPECT_NE(named.sentence.find("28 rad/s instead of 300"), std::string::npos) << named.sentence;
  c.closes({0.2, 0.4}, 0.3);
  EXPECT_EQ(c.judged().status, "unknown") << "most of the gap remains";
  c.closes({-0.5, 1.0}, 0.3);
  c.fitted[0].prior_value = 80;
  EXPECT_EQ(c.judged().status, "unknown") << "what a model lacks may make so much";
  c.fitted[0].prior_value = 300, c.fitted[0].value = 4;
  EXPECT_EQ(c.judged().status, "unknown") << "nothing flies with motors as slow";
  c.fitted[0].value = 28;
  EXPECT_EQ(c.judged().status, "identified");
  c.fitted[1].value = 0.02;
  EXPECT_EQ(c.judged().status, "unknown") << "no motor swings so";
}

TEST(Verdict, ABatteryThatTheThrustShowsIsNamedWhateverIsBesideIt) {
  Case c({"battery_sag", "rotor_tilt", "gyroscopic", "cg_offset"},
         {"battery_sag", "rotor_tilt", "gyroscopic", "cg_offset"});
  c.weighs({0, 1, 2, 3}, 1.0);
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.thrust = {
      .stretches = 60, .logs = 3, .rising = 3, .n = 0.7, .n_std = 0.02, .varies = 0.06, .left = 0.02};
  const Judged named = c.judged();
  EXPECT_EQ(named.status, "identified");
  EXPECT_EQ(named.effects, Names{"battery_sag"});
  EXPECT_NE(named.sentence.find("6.0 %, by 2.0 %"), std::string::npos) << named.sentence;
  EXPECT_TRUE(named.refused) << "the others";
  c.search.thrust.rising = 2;
  EXPECT_EQ(c.judged().status, "unknown") << "in one log it falls";
  c.search.thrust.rising = 3, c.search.thrust.left = 0.04;
  EXPECT_EQ(c.judged().status, "unknown") << "most of it is something else";
  c.search.thrust.left = 0.02, c.search.thrust.n = 3.0;
  EXPECT_EQ(c.judged().status, "unknown") << "no motor does that";
  c.search.thrust.n = 0.7;
  std::erase_if(c.search.best.adopted, [](const Candidate& a) { return a.name == "battery_sag"; });
  EXPECT_EQ(c.judged().status, "unknown") << "no model with it stands";
}

TEST(Verdict, FourCausesInTheVehicleAreNoAnswerThoughNothingElseExplainsIt) {
  Case c({"rotor_drag", "rotor_tilt", "gyroscopic", "battery_sag", "imu_bias"},
         {"rotor_drag", "rotor_tilt", "gyroscopic", "imu_bias"});
  c.weighs({0, 1, 2, 4}, 1.0);
  EXPECT_EQ(c.judged().status, "identified");
  c.search.best.adopted.push_back({"battery_sag"});
  c.search.sets = {{{0, 1, 2, 3, 4}, 0.0, 1.0}};
  const Judged many = c.judged();
  EXPECT_EQ(many.status, "unknown");
  EXPECT_EQ(many.confused_with.size(), 5U);
}

TEST(Verdict, HowTheSensorIsMountedIsNamedOnTopOfThree) {
  Case c({"rotor_drag", "wind", "ground_effect", "imu_bias", "imu_lever_arm", "axial_inflow",
          "translational_lift", "rotor_tilt"},
         {"wind", "ground_effect", "imu_bias"});
  c.weighs({1, 2, 3}, 0.6);
  c.weighs({1, 2, 4}, 0.4);
  const Judged mounted = c.judged();
  EXPECT_EQ(mounted.status, "ambiguous");
  EXPECT_EQ(mounted.effects.size() + mounted.confused_with.size(), 4U);
  c.search.sets[0].members = {1, 2, 3, 5};
  c.search.sets[1].members = {0, 2, 4, 5};
  c.search.best.adopted.push_back({"axial_inflow"});
  EXPECT_EQ(c.judged().status, "ambiguous");  // between wind and drag alone
  c.search.sets[1].members = {0, 4, 6, 7};
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(Verdict, WhatIsCertainIsNamedBesideWhatIsLeftOpen) {
  Case c({"battery_sag", "cg_offset", "payload", "rotor_tilt", "products_of_inertia", "rotor_mismatch"},
         {"battery_sag", "cg_offset"});
  c.weighs({0, 1}, 0.6), c.weighs({0, 2}, 0.25), c.weighs({0, 3}, 0.15);
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "ambiguous");
  EXPECT_EQ(seen.effects, (Names{"battery_sag", "cg_offset"}));
  EXPECT_EQ(seen.confused_with, (Names{"payload", "rotor_tilt"}));
  EXPECT_NE(seen.sentence.find("but payload or rotor_tilt in place of cg_offset would"), std::string::npos)
      << seen.sentence;
  c.weighs({0, 4}, 0.1);  // four of which it may be any
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(Verdict, TheDragByWhichWindActsIsNoRivalOfIt) {
  Case c({"rotor_drag", "wind", "rotor_tilt"}, {"rotor_drag", "wind"});
  c.weighs({0, 1}, 0.8), c.weighs({0, 2}, 0.2);
  EXPECT_EQ(c.judged().confused_with, Names{"rotor_tilt"});
  c.search.sets.clear();
  c.weighs({0, 1}, 0.2), c.weighs({0}, 0.8);  // unless there is no wind
  EXPECT_EQ(c.judged().confused_with, Names{"rotor_drag"});
}

TEST(Verdict, TheDragThatWindBringsAlongIsNotNamed) {
  Case c({"rotor_drag", "wind"}, {"rotor_drag", "wind"});
  c.weighs({0, 1}, 1.0);
  EXPECT_EQ(c.judged().effects, Names{"wind"});
}

// Motors far from what was stated are that whatever else is there, unless their own speeds show another
// thing.
TEST(Verdict, APlainlyWrongLagIsNamedUnlessTheSpeedsAreNoLag) {
  Case c({"parameter:omega_m"}, {"parameter:omega_m"});
  c.weighs({0}, 1.0);
  Parameter omega_m, zeta_m;
  omega_m.name = "omega_m", omega_m.value = 30, omega_m.prior_value = 300, omega_m.prior_std = 15;
  omega_m.std = 1;
  zeta_m.name = "zeta_m", zeta_m.value = 0.8;
  c.fitted = {omega_m, zeta_m};
  c.rival.gain[0] = 300.0;
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "identified") << seen.sentence;
  EXPECT_NE(seen.sentence.find("The motors are not what was stated"), std::string::npos) << seen.sentence;
  c.rival.sensors = {{"omega1", 30.0}, {"motors", 30.0}};  // slack between command and rotor
  EXPECT_EQ(c.judged().status, "unknown");
  c.rival.sensors.clear(), c.fitted[0].value = 5000, c.fitted[0].std = 2500;  // faster than any row shows
  EXPECT_EQ(c.judged().status, "unknown") << c.judged().sentence;
}

TEST(Verdict, WhereNothingIsMissedNothingIsNamed) {
  Case c({"motor_delay"}, {"motor_delay"});
  c.weighs({0}, 1.0);
  EXPECT_EQ(c.judged().effects, Names{"motor_delay"});
  c.gap.before = 0.7, c.gap.after = 0.7, c.gap.floor = 1.0, c.gap.closed = std::nan("");
  EXPECT_EQ(c.judged().status, "none");
  EXPECT_TRUE(c.judged().effects.empty());
  c.gap.before = 1.0;
  EXPECT_EQ(c.judged().effects, Names{"motor_delay"});
}

TEST(Verdict, ACauseWhoseModelCannotBeFlownIsNotNamed) {
  Case c({"rotor_drag"}, {});
  c.search.ran_away = {"rotor_drag"};
  const Judged lost = c.judged();
  EXPECT_EQ(lost.status, "unknown");
  EXPECT_EQ(lost.confused_with, Names{"rotor_drag"});
}

}  // namespace
}  // namespace ident
