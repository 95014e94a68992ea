// Short versions of the bench campaigns, with bounds that a right estimator fails about once in 10,000 runs.
#include "support/bench_campaign.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ident::bench {
namespace {

constexpr int kRuns = 100;

/// The aims of the full campaign (bias below 0.1 standard deviations, error at most 1.1 times the bound, 95 %
/// intervals that hold), each widened by four standard errors of this many runs.
void expect_honest(const Tallies& tallies, double least_coverage = 0.95) {
  for (const auto& [name, tally] : tallies) {
    EXPECT_EQ(tally.runs, kRuns) << name;
    EXPECT_LT(std::fabs(tally.bias()), 0.1 + 4.0 / std::sqrt(kRuns)) << name;
    EXPECT_LT(tally.efficiency(), 1.1 * (1.0 + 4.0 / std::sqrt(2.0 * kRuns))) << name;
    EXPECT_GE(tally.coverage(), least_coverage - 4.0 * std::sqrt(0.05 * 0.95 / kRuns)) << name;
  }
}

TEST(BenchCampaign, InertiasAreUnbiasedEfficientAndHonest) { expect_honest(inertia_campaign(kRuns, 11, {})); }

TEST(BenchCampaign, InertiasAreSoWithOutliers) {
  expect_honest(inertia_campaign(kRuns, 12, {.outliers = 0.01}));
}

TEST(BenchCampaign, ThrustConstantsAreUnbiasedEfficientAndHonest) {
  expect_honest(thrust_campaign(kRuns, 21, {}));
}

TEST(BenchCampaign, ThrustConstantsAreSoWithOutliers) {
  expect_honest(thrust_campaign(kRuns, 22, {.outliers = 0.01}));
}

TEST(BenchCampaign, ThrustConstantsAreHonestInColouredNoise) {
  expect_honest(thrust_campaign(kRuns, 23, {.rho = 0.9}), 0.91);
}

}  // namespace
}  // namespace ident::bench
