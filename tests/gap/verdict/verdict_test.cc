// What a verdict says, on searches made by hand.
#include "ident/gap/verdict/verdict.h"

#include <gtest/gtest.h>

#include "support/verdict_case.h"

namespace ident {
namespace {

using Names = std::vector<std::string>;
using Case = VerdictCase;

Case one_cause() {
  Case c({"rotor_drag"}, {"rotor_drag"});
  c.weighs({0}, 1.0);
  return c;
}

TEST(Verdict, ACauseThatExplainsEverythingIsIdentified) {
  const Judged seen = one_cause().judged();
  EXPECT_EQ(seen.status, "identified");
  EXPECT_EQ(seen.effects, Names{"rotor_drag"});
  EXPECT_NE(seen.sentence.find("97 %"), std::string::npos) << seen.sentence;
}

TEST(Verdict, AContradictedBenchValueIsAFindingBesideTheCause) {
  Case c = one_cause();
  c.contradicts_kT(17);
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "identified");
  ASSERT_EQ(seen.findings.size(), 1u);
  EXPECT_EQ(seen.findings[0].constant, "kT");
  EXPECT_NE(seen.sentence.find("17 standard deviations"), std::string::npos) << seen.sentence;
}

TEST(Verdict, WhatSwingsBesideACauseTakesNothingBackOfIt) {
  Case c = one_cause();
  c.lines.push_back({.channel = "Mx", .hz = 12.1, .height = 30, .share = 0.2});
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "partly");
  EXPECT_EQ(seen.effects, Names{"rotor_drag"});
  EXPECT_NE(seen.rest.said().find("12.1 Hz in Mx"), std::string::npos) << seen.rest.said();
}

TEST(Verdict, ACauseIsNotIdentifiedWhereMostOfTheGapRemainsAndIsNoGust) {
  Case c = one_cause();
  c.closes({0.3, 0.5}, 0.4);  // sqrt(1 + 0.6 * 99) = 7.8 times the floor is left
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "partly");
  EXPECT_NEAR(seen.remaining.value, 0.6, 1e-12);
}

TEST(Verdict, WhatATrialThatCouldNotBeFlownLeavesOpenTakesNothingBack) {
  Case c = one_cause();
  c.search.ran_away = {"thrust_curve"};
  EXPECT_EQ(c.judged().effects, Names{"rotor_drag"});
  Case nothing({"thrust_curve"}, {});
  nothing.weighs({}, 1.0);
  nothing.search.ran_away = {"thrust_curve"};
  nothing.gap.after = nothing.gap.floor;
  const Judged seen = nothing.judged();
  EXPECT_EQ(seen.status, "unknown");
  EXPECT_EQ(seen.confused_with, Names{"thrust_curve"});
}

TEST(Verdict, WhatIsHardlyThereBesideAStrongCauseIsNotNamed) {
  Case c({"motor_asymmetry", "sensor_delay"}, {"motor_asymmetry", "sensor_delay"});
  c.weighs({0}, 0.97), c.weighs({0, 1}, 0.03);
  EXPECT_EQ(c.judged().effects, Names{"motor_asymmetry"});
  c.search.sets.clear();
  c.weighs({0}, 0.6), c.weighs({0, 1}, 0.4);
  EXPECT_EQ(c.judged().effects, (Names{"motor_asymmetry", "sensor_delay"}));
}

TEST(Verdict, ACauseBesideTheOneFoundIsNoRivalAndOneInItsPlaceIs) {
  Case c({"rotor_drag", "cg_offset", "payload", "rotor_mismatch"}, {"cg_offset"});
  c.weighs({1}, 0.3), c.weighs({0, 1}, 0.7);
  EXPECT_EQ(c.judged().status, "identified");
  c.search.sets.clear();
  c.weighs({1}, 0.6), c.weighs({2}, 0.4);
  const Judged instead = c.judged();
  EXPECT_EQ(instead.status, "ambiguous");
  EXPECT_EQ(instead.effects, Names{"cg_offset"});
  EXPECT_EQ(instead.confused_with, Names{"payload"});
}

TEST(Verdict, ACauseWhoseWorkOneThatWasLeftOutMayDoIsNotNamed) {
  Case c({"cg_offset", "payload"}, {"cg_offset"});
  c.search.beside_left_out = {{"cg_offset", 0.5}};
  c.weighs({0}, 1.0);
  EXPECT_EQ(c.judged().status, "unknown");
  EXPECT_EQ(c.judged().confused_with, Names{"cg_offset"});
}

TEST(Verdict, ALightPayloadIsAShiftedCentreOfGravityAsWell) {
  Case c({"payload", "cg_offset"}, {"payload"});
  c.weighs({0}, 0.97), c.weighs({1}, 0.03);
  Parameter mass;
  mass.name = "payload.m", mass.value = 0.06, mass.std = 0.01;
  c.fitted = {mass};
  EXPECT_EQ(c.judged().status, "identified");
  c.fitted[0].std = 0.02;
  EXPECT_EQ(c.judged().status, "ambiguous");
  EXPECT_EQ(c.judged().confused_with, Names{"cg_offset"});
}

TEST(Verdict, TheDragThatWindBringsAlongIsNotNamed) {
  Case c({"rotor_drag", "wind"}, {"rotor_drag", "wind"});
  c.weighs({0, 1}, 1.0);
  EXPECT_EQ(c.judged().effects, Names{"wind"});
}

TEST(Verdict, TheDragByWhichWindActsIsNoRivalOfIt) {
  Case c({"rotor_drag", "wind", "rotor_tilt"}, {"rotor_drag", "wind"});
  c.weighs({0, 1}, 0.8), c.weighs({0, 2}, 0.2);
  EXPECT_EQ(c.judged().confused_with, Names{"rotor_tilt"});
  c.search.sets.clear();
  c.weighs({0, 1}, 0.2), c.weighs({0}, 0.8);  // unless there is no wind
  EXPECT_EQ(c.judged().confused_with, Names{"rotor_drag"});
}

TEST(Verdict, AStandInIsNotNamedAndTheOthersAre) {
  // A regression predicts a fifth of what all explain, and the size of one of two changes by itself.
  Case c({"gyroscopic", "rotor_tilt"}, {"gyroscopic", "rotor_tilt"});
  c.weighs({0, 1}, 1.0);
  c.rival.gain[0] = 400;
  c.search.asked = {{{"roll", 0.0, 0.01, 0.5}}, {{"roll", 1.5, 0.05, 0.5}}};
  const Judged seen = c.judged();
  EXPECT_LT(seen.causes[1].right, seen.causes[0].right);
}

TEST(Verdict, ABatteryThatTheThrustShowsIsNamedWhateverIsBesideIt) {
  Case c({"battery_sag", "rotor_tilt"}, {"battery_sag", "rotor_tilt"});
  c.weighs({1}, 0.9), c.weighs({0, 1}, 0.1);
  c.rival.gain[0] = 1e5;
  c.search.thrust = {
      .stretches = 60, .logs = 3, .rising = 3, .n = 0.7, .n_std = 0.02, .varies = 0.06, .left = 0.02};
  const Judged named = c.judged();
  EXPECT_EQ(named.effects, Names{"battery_sag"});
  EXPECT_EQ(named.status, "partly");
}

TEST(Verdict, WithoutCauseAndWithoutSignThereIsNoGap) {
  Case c({"rotor_drag"}, {});
  c.weighs({}, 1.0);
  c.gap.after = 1.2, c.gap.floor = 1.0;  // as chance has it
  EXPECT_EQ(c.judged().status, "none");
  c.gap.after = 3.0;
  EXPECT_EQ(c.judged().status, "unknown") << "three times the noise of sensors and air is no chance";
}

TEST(Verdict, WhatStrikesIsUnknownWithoutACauseAndGustsAboutYawAreNot) {
  Case c({"rotor_drag"}, {});
  c.weighs({}, 1.0);
  c.gap.after = c.gap.floor;
  c.jumps.push_back({"Mz", 0, 5, 5, 8.0, 3.0});
  EXPECT_EQ(c.judged().status, "none");
  c.jumps.push_back({"Fz", 0, 5, 5, 8.0, 3.0});
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(Verdict, CausesThatAreNotNamedAreAmongTheNearest) {
  Judged verdict = one_cause().judged();
  verdict = unnamed(std::move(verdict));
  EXPECT_EQ(verdict.status, "unknown");
  EXPECT_TRUE(verdict.effects.empty());
  EXPECT_EQ(verdict.confused_with, Names{"rotor_drag"});
  EXPECT_LT(verdict.causes[0].probability(), 0.5);
}

// Along measured motion, where shares are of the side on which a cause acts.
TEST(Verdict, CausesThatCannotCloseATenthBetweenThemAreNoAnswer) {
  Case c = one_cause();
  c.shares.causes[0].share = {0.05, {0.01, 0.07}};
  c.shares.remaining = {0.95, {0.92, 1.0}};
  c.by_side = true;
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "unknown");
  EXPECT_TRUE(seen.effects.empty());
  EXPECT_NE(seen.sentence.find("rotor_drag (5 % [1, 7] of the gap) is too little to be the answer"),
            std::string::npos)
      << seen.sentence;
  c.shares.causes[0].share.ci95[1] = 0.12;
  EXPECT_EQ(c.judged().effects, Names{"rotor_drag"});
}

TEST(Verdict, WhatRefittedConstantsCloseIsToldBeforeTheCausesShareTheRest) {
  Case c = one_cause();
  c.shares.without_causes = 2.0;  // of 10 times the floor: (100 - 4)/(100 - 1) are closed
  const Judged seen = c.judged();
  EXPECT_NE(seen.sentence.find("close 96 % of the gap"), std::string::npos) << seen.sentence;
  EXPECT_NE(seen.sentence.find("of the rest)"), std::string::npos) << seen.sentence;
}

// Thrust at a command is told where kT and km are not told apart; what hardly moved is left out.
TEST(Verdict, WhatIsKnownIsSaidWhereNoCauseIsCertain) {
  Case c({"rotor_drag"}, {});
  c.weighs({}, 1.0);
  c.search.ran_away = {"rotor_drag"};
  c.shares.without_causes = 2.0;
  const auto constant = [](const char* name, double change, bool identifiable) {
    return Parameter{.name = name,
                     .value = 1 + change,
                     .std = 0.005,
                     .identifiable = identifiable,
                     .prior_value = 1.0,
                     .prior_std = 0.1};
  };
  c.fitted = {constant("kT", 0.1, false), constant("km", -0.01, true), constant("Jxx", -0.2, true),
              constant("Jyy", 0.01, true), constant("Jzz", 0.3, false)};
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "unknown");
  EXPECT_NE(seen.sentence.find("(Jxx -20 %, kT km^2 +8 %), close 96 % of the gap"), std::string::npos)
      << seen.sentence;
  c.fitted[0].identifiable = true;
  EXPECT_NE(c.judged().sentence.find("(Jxx -20 %, kT +10 %)"), std::string::npos) << c.judged().sentence;
}

TEST(Verdict, ANameIsLessProbableTheLessSpeaksForIt) {
  NameEvidence x{.name = "rotor_drag", .closes = 0.9, .share = 1};
  x.told = 4;
  const double plain = probability_right(x);
  x.told = 2.5;
  EXPECT_DOUBLE_EQ(probability_right(x), plain);
  x.told = 1.0;
  EXPECT_LT(probability_right(x), 0.7);
  EXPECT_GT(plain, 0.9);
}

}  // namespace
}  // namespace ident
