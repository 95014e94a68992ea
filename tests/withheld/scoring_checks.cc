// The scorer's own checks: what each kind of answer is worth.
#include <gtest/gtest.h>

#include "tally.h"

namespace withheld {
namespace {

Truth truth_of(const Names& names) {
  Truth truth;
  truth.kind = names.empty() ? "none" : names.size() == 1 ? "single" : "pair";
  for (const std::string& name : names) truth.effects.push_back({name, "exact", 4, 4, {}});
  return truth;
}

Answer answer_of(const std::string& status, const Names& effects, const Names& confused = {}) {
  Answer answer;
  answer.given = true;
  answer.status = status;
  answer.effects = effects;
  answer.confused_with = confused;
  return answer;
}

TEST(WithheldScore, NamesExactlyTheTruthOrNot) {
  const Truth drag = truth_of({"rotor_drag"});
  EXPECT_EQ(outcome_of(drag, answer_of("identified", {"rotor_drag"})), Outcome::right);
  EXPECT_EQ(outcome_of(drag, answer_of("identified", {"rotor_drag", "payload"})), Outcome::extra);
  EXPECT_EQ(outcome_of(drag, answer_of("identified", {"payload"})), Outcome::wrong);
  EXPECT_EQ(outcome_of(drag, answer_of("unknown", {})), Outcome::unknown);
  EXPECT_EQ(outcome_of(drag, answer_of("none", {})), Outcome::none);
  EXPECT_EQ(outcome_of(drag, Answer()), Outcome::failed);
}

TEST(WithheldScore, AGroupCountsUpToThreeCauses) {
  const Truth drag = truth_of({"rotor_drag"});
  EXPECT_EQ(outcome_of(drag, answer_of("ambiguous", {"wind"}, {"rotor_drag"})), Outcome::group);
  EXPECT_EQ(outcome_of(drag, answer_of("ambiguous", {"wind"}, {"payload"})), Outcome::wide);
  EXPECT_EQ(outcome_of(drag, answer_of("ambiguous", {"wind", "rotor_drag"}, {"payload", "imu_bias"})),
            Outcome::wide);
}

TEST(WithheldScore, WhatTrulyComesAlongIsNoFalseName) {
  Truth wind = truth_of({"wind"});
  wind.accompanying = {"rotor_drag"};
  EXPECT_EQ(outcome_of(wind, answer_of("identified", {"wind", "rotor_drag"})), Outcome::right);
  EXPECT_EQ(outcome_of(wind, answer_of("identified", {"rotor_drag"})), Outcome::wrong);
}

TEST(WithheldScore, APairIsNamedWhollyOrInPart) {
  const Truth pair = truth_of({"rotor_drag", "payload"});
  EXPECT_EQ(outcome_of(pair, answer_of("identified", {"payload", "rotor_drag"})), Outcome::right);
  EXPECT_EQ(outcome_of(pair, answer_of("identified", {"payload"})), Outcome::part);
  EXPECT_EQ(outcome_of(pair, answer_of("identified", {"payload", "wind"})), Outcome::wrong);
}

TEST(WithheldScore, NothingIsRightButSilenceWhereThereIsNoEffect) {
  const Truth none = truth_of({});
  EXPECT_EQ(outcome_of(none, answer_of("none", {})), Outcome::none);
  EXPECT_EQ(outcome_of(none, answer_of("identified", {"wind"})), Outcome::wrong);
  EXPECT_EQ(outcome_without_truth(answer_of("unknown", {})), Outcome::unknown);
  EXPECT_EQ(outcome_without_truth(answer_of("ambiguous", {"wind"}, {"payload"})), Outcome::wide);
}

TEST(WithheldScore, RecoveryLooksAtNamedEffectsOnly) {
  Scored scored;
  scored.truth = truth_of({"rotor_drag"});
  scored.truth.effects[0].parameters = {{"rotor_drag.kd", 1.0}};
  scored.answer = answer_of("identified", {"rotor_drag"});
  scored.answer.candidates["rotor_drag"].parameters["rotor_drag.kd"] = {1.15, 0.1};
  EXPECT_EQ(recovery({scored}, "exact").hits, 1);
  scored.answer.candidates["rotor_drag"].parameters["rotor_drag.kd"] = {1.25, 0.1};
  EXPECT_EQ(recovery({scored}, "exact").hits, 0);
  scored.answer.status = "unknown";
  EXPECT_EQ(recovery({scored}, "exact").of, 0);
}

}  // namespace
}  // namespace withheld
