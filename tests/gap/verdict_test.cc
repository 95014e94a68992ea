// The rules of a verdict, one by one, on searches made by hand.
#include "ident/gap/verdict.h"

#include <gtest/gtest.h>

namespace ident {
namespace {

using Names = std::vector<std::string>;

// What a search found, all else as it is where a cause explains everything.
struct Case {
  SearchResult search;
  GapClosed gap;
  Rival rival;
  std::vector<SpectralLine> lines;
  std::vector<Burst> jumps;
  std::vector<Parameter> fitted;

  Case(const Names& candidates, const Names& found) {
    for (const std::string& name : candidates) search.problem.candidates.push_back({name});
    for (const std::string& name : found) {
      search.best.adopted.push_back({name});
      search.alone.push_back({name, 1000.0});
    }
    closes({0.9, 1.0}, 0.97);
  }
  void closes(std::array<double, 2> ci95, double closed) { gap = {closed, ci95, 10.0, 1.1, 1.0}; }
  void weighs(const std::vector<int>& members, double probability) {
    search.sets.push_back({members, 0.0, probability});
  }
  Judged judged() const { return judge(search, gap, rival, lines, jumps, fitted); }
};

TEST(Verdict, NothingFoundIsNoneUnlessSomethingCanBePredictedSwingsOrStrikes) {
  Case c({"rotor_drag"}, {});
  EXPECT_EQ(c.judged().status, "none");
  c.jumps.push_back({"Mx", 0, 5, 8.0, 3.0});
  EXPECT_EQ(c.judged().status, "unknown");
  c.jumps.clear();
  c.lines.push_back({"az", 36.0, 20.0, 0.3});
  EXPECT_EQ(c.judged().status, "unknown");
  c.lines.clear();
  c.rival.gain[2] = 40.0;
  EXPECT_EQ(c.judged().status, "none");
  c.rival.sensors.emplace_back("r", 20.0);
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "unknown");
  EXPECT_NE(seen.sentence.find("Fz"), std::string::npos) << seen.sentence;
}

TEST(Verdict, ACauseBesideTheOneFoundIsNoRivalAndOneInItsPlaceIs) {
  Case c({"rotor_drag", "cg_offset", "payload"}, {"cg_offset"});
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

TEST(Verdict, WhatARegressionStillPredictsMakesItUnknownByItsShareOfWhatIsExplained) {
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

TEST(Verdict, AGapThatMostlyRemainsIsUnknownAndOneThatRemainsInPartIsSaidSo) {
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
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(Verdict, AContradictedBenchValueMakesItUnknownUnlessItIsTheCause) {
  Case c({"rotor_tilt", "parameter:kT"}, {"rotor_tilt"});
  c.weighs({0}, 1.0);
  Parameter kT;
  kT.name = "kT", kT.value = 1.3, kT.prior_value = 1.0, kT.prior_std = 0.05;
  kT.pull = 6.0, kT.from_flight = 0.9;
  c.fitted = {kT};
  const Judged against = c.judged();
  EXPECT_EQ(against.status, "unknown");
  EXPECT_NE(against.sentence.find("kT"), std::string::npos) << against.sentence;
  c.search.best.adopted.push_back({"parameter:kT"});
  c.search.sets = {{{0, 1}, 0.0, 1.0}};
  EXPECT_EQ(c.judged().status, "identified");
}

TEST(Verdict, CausesThatMoveMassesAreNotNamedWhereAPayloadWasNotTried) {
  Case c({"cg_offset", "products_of_inertia", "payload"}, {"cg_offset", "products_of_inertia"});
  c.weighs({0, 1}, 1.0);
  EXPECT_EQ(c.judged().status, "identified");
  c.search.problem.candidates.pop_back();
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.best.adopted.pop_back();
  c.search.sets = {{{0}, 0.0, 1.0}};
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.best.adopted[0].name = c.search.problem.candidates[0].name = "parameter:Jxx";
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

TEST(Verdict, AConstantOfTheVehicleThatChangesInFlightIsNotTheCause) {
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

TEST(Verdict, APayloadWhoseMassIsNotSeenIsAShiftedCentreOfGravityAsWell) {
  Case c({"payload", "cg_offset"}, {"payload"});
  c.weighs({0}, 1.0);
  Parameter mass;
  mass.name = "payload.m", mass.value = 0.06, mass.std = 0.01;
  c.fitted = {mass};
  EXPECT_EQ(c.judged().status, "identified");
  c.fitted[0].std = 0.02;
  const Judged either = c.judged();
  EXPECT_EQ(either.status, "ambiguous");
  EXPECT_EQ(either.effects, Names{"payload"});
  EXPECT_EQ(either.confused_with, Names{"cg_offset"});
  c.search.best.adopted.push_back({"rotor_drag"});  // its place does what the other cause leaves
  EXPECT_EQ(c.judged().status, "unknown");
  c.search.best.adopted.pop_back();
  c.search.problem.candidates.pop_back();
  EXPECT_EQ(c.judged().status, "unknown");
  c.fitted[0].value = -0.06, c.fitted[0].std = 0.01;  // far from none on the wrong side
  EXPECT_EQ(c.judged().status, "unknown");
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

TEST(Verdict, FlappingIsNotNamedWhereTheDragThatComesWithItWasNotTried) {
  Case c({"blade_flapping", "rotor_drag"}, {"blade_flapping"});
  c.weighs({0}, 1.0);
  EXPECT_EQ(c.judged().status, "identified");
  c.search.problem.candidates.pop_back();
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(Verdict, ACauseOfTheDriveMayLeaveAThirdOfWhatItGainsAndOtherCausesLendItNothing) {
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

TEST(Verdict, ThreeWrongBenchValuesAtOnceAreNoAnswer) {
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

TEST(Verdict, APayloadAndAShiftedCentreOfGravityAtOnceAreNoAnswer) {
  Case c({"payload", "cg_offset"}, {"payload", "cg_offset"});
  c.weighs({0, 1}, 1.0);
  EXPECT_EQ(c.judged().status, "unknown");
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
  Case c({"rotor_drag", "wind", "ground_effect", "imu_bias", "imu_lever_arm"},
         {"wind", "ground_effect", "imu_bias"});
  c.weighs({1, 2, 3}, 0.6);
  c.weighs({1, 2, 4}, 0.4);
  const Judged mounted = c.judged();
  EXPECT_EQ(mounted.status, "ambiguous");
  EXPECT_EQ(mounted.effects.size() + mounted.confused_with.size(), 4U);
  c.search.sets[1].members = {0, 2, 4};
  c.search.best.adopted.push_back({"axial_inflow"});
  EXPECT_EQ(c.judged().status, "unknown");
}

TEST(Verdict, WithoutACauseAContradictedBenchValueThatWasNotTriedIsAGap) {
  Case c({"parameter:kT"}, {});
  Parameter kT;
  kT.name = "kT", kT.value = 1.3, kT.prior_value = 1.0, kT.prior_std = 0.05;
  kT.pull = 6.0, kT.from_flight = 0.9;
  Parameter worse = kT;
  worse.name = "km", worse.pull = 9.0;
  c.search.problem.candidates.push_back({"parameter:km"});
  c.fitted = {worse, kT};
  EXPECT_EQ(c.judged().status, "none");  // both were tried, and gain too little
  c.search.problem.candidates[0].name = "parameter:m";
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "unknown");
  EXPECT_NE(seen.sentence.find("kT"), std::string::npos) << seen.sentence;
}

TEST(Verdict, TheSameIllOfTwoRotorsIsNotNamed) {
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

TEST(Verdict, TheDragThatWindBringsAlongIsNotNamed) {
  Case c({"rotor_drag", "wind"}, {"rotor_drag", "wind"});
  c.weighs({0, 1}, 1.0);
  EXPECT_EQ(c.judged().effects, Names{"wind"});
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
