// Gains and weights of sets of causes on quadratic forms made by hand.
#include "ident/gap/weigh_sets.h"

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
