// Gains and weights of sets of causes on quadratic forms made by hand.
#include "ident/gap/weigh_sets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ident {
namespace {

// One base constant, then causes over unknowns that know nothing of each other, each with the information `S`
// and its minimum at `at`.
Standing standing(const std::vector<std::string>& names, const Eigen::VectorXd& S,
                  const Eigen::VectorXd& at) {
  Standing out;
  for (const std::string& name : names) out.problem.constants.push_back({.name = name, .start = 0.0});
  out.problem.base = 1;
  const auto n = static_cast<Eigen::Index>(names.size());
  out.form.S = S.asDiagonal();
  out.form.g = -S.cwiseProduct(at);
  out.form.prior_g = out.form.prior_info = out.form.null = Eigen::VectorXd::Zero(n);
  out.form.base = 1, out.form.constants = static_cast<int>(n);
  return out;
}

// The gain of a payload whose mass is known to be none: what the shift gains, less what the least mass costs
// that makes such a shift within reach.
TEST(WeighSets, APayloadWeighsWhatItsShiftNeeds) {
  constexpr double kShift = 0.005, kMassForShift = 2.0, kMass = 1e4, kPlace = 1e6;
  Standing at = standing({"m", "payload.m", "cg_offset.x", "cg_offset.y", "cg_offset.z"},
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
  Standing at = standing({"m", "imu_bias.ax", "imu_lever_arm.x", "imu_lever_arm.y"},
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
