// Gains and weights of sets of causes on quadratic forms made by hand.
#include "ident/gap/search/weigh_sets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/standing_by_hand.h"

namespace ident {
namespace {

// The gain of a payload whose mass is known to be none: what the shift gains, less what the least mass costs
// that makes such a shift within reach.
TEST(WeighSets, APayloadWeighsWhatItsShiftNeeds) {
  constexpr double kShift = 0.005, kMassForShift = 2.0, kMass = 1e4, kPlace = 1e6;
  Standing at = standing_by_hand({"m", "payload.m", "cg_offset.x", "cg_offset.y", "cg_offset.z"},
                                 Eigen::VectorXd{{1.0, kMass, kPlace, kPlace, kPlace}},
                                 Eigen::VectorXd{{0.0, 0.0, 0.6 * kShift, -0.8 * kShift, 0.0}});
  Candidate payload{"payload", {1, 2, 3, 4}, -1, -1, true};
  at.problem.candidates = {payload};
  const double free = kPlace * kShift * kShift, least = kMassForShift * kShift;
  EXPECT_NEAR(gain_of(at.form, at.problem, {0}).gain, free, 1e-6 * free);
  at.problem.candidates[0].mass_for_shift = kMassForShift;
  const SetGain bound = gain_of(at.form, at.problem, {0});
  EXPECT_NEAR(bound.gain, free - kMass * least * least, 1e-6 * free);
  EXPECT_NEAR(bound.step[1], least, 1e-9);
}

// Gusts that push above the centre of gravity look like one that sits far off along z.
TEST(WeighSets, ACentreOfGravityFarOffAlongZAloneGainsNothing) {
  constexpr double kInfo = 1e6, kHighest = 0.02;
  const auto gain = [&](double x, double z) {
    Standing at =
        standing_by_hand({"m", "cg_offset.x", "cg_offset.y", "cg_offset.z"},
                         Eigen::VectorXd{{1.0, kInfo, kInfo, kInfo}}, Eigen::VectorXd{{0.0, x, 0.0, z}});
    Candidate cg{"cg_offset", {1, 2, 3}};
    cg.height = 3, cg.highest = kHighest;
    at.problem.candidates = {cg};
    return gain_of(at.form, at.problem, {0});
  };
  const SetGain near = gain(0.0, 0.015), far = gain(0.0, 0.03), both = gain(0.01, 0.03);
  EXPECT_NEAR(near.gain, kInfo * 0.015 * 0.015, 1e-3);
  EXPECT_EQ(near.degrees, 3);
  EXPECT_NEAR(far.gain, 0.0, 1e-6);
  EXPECT_EQ(far.degrees, 2);
  EXPECT_NEAR(both.gain, kInfo * 0.01 * 0.01, 1e-3);  // what its place in the plane of the rotors explains
  EXPECT_EQ(both.step[3], 0.0);
}

// A heavy payload carries it as far as its mass does.
TEST(WeighSets, APayloadMovesTheCentreOfGravityAlongZByItsMass) {
  constexpr double kInfo = 1e6, kMassForShift = 2.0;
  const auto gain = [&](double mass) {
    Standing at = standing_by_hand({"m", "payload.m", "cg_offset.x", "cg_offset.y", "cg_offset.z"},
                                   Eigen::VectorXd{{1.0, 1e4, kInfo, kInfo, kInfo}},
                                   Eigen::VectorXd{{0.0, mass, 0.0, 0.0, 0.05}});
    Candidate payload{"payload", {1, 2, 3, 4}, -1, -1, true};
    payload.mass_for_shift = kMassForShift, payload.height = 4, payload.highest = 0.02;
    at.problem.candidates = {payload};
    return gain_of(at.form, at.problem, {0}).gain;
  };
  EXPECT_NEAR(gain(0.1), 1e4 * 0.1 * 0.1 + kInfo * 0.05 * 0.05, 1e-2);
  EXPECT_NEAR(gain(0.02), 1e4 * 0.02 * 0.02, 1e-2);
}

TEST(WeighSets, OfTwoThatExplainItAsWellTheOneWithFewerUnknownsIsMoreProbable) {
  Standing at =
      standing_by_hand({"m", "imu_bias.ax", "imu_lever_arm.x", "imu_lever_arm.y"},
                       Eigen::VectorXd{{1.0, 1e4, 1e4, 1e4}}, Eigen::VectorXd{{0.0, 0.1, 0.1, 0.0}});
  at.problem.candidates = {{"imu_bias", {1}}, {"imu_lever_arm", {2, 3}}};
  const std::vector<WeighedSet> sets = weighed_sets(at);
  const auto probability = [&](const std::vector<int>& members) {
    for (const WeighedSet& set : sets)
      if (set.members == members) return set.probability;
    return 0.0;
  };
  EXPECT_GT(probability({0}), 2 * probability({1}));
  EXPECT_NEAR(log_odds(at, {0}, {1}), std::log(probability({0}) / probability({1})), 1e-9);
}

}  // namespace
}  // namespace ident
