// Distributions against tables, robust summaries against small samples worked out by hand.
#include "ident/core/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ident {
namespace {

TEST(Statistics, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
  EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-10);
  EXPECT_NEAR(t_quantile(0.975, 1), 12.706204736, 1e-8);  // tan(0.475 pi)
  EXPECT_NEAR(t_quantile(0.975, 10), 2.228138852, 1e-8);
  EXPECT_NEAR(t_quantile(0.025, 10), -2.228138852, 1e-8);
  EXPECT_NEAR(t95(1e9), 1.959963985, 1e-8);
}

TEST(Statistics, DistributionFunctionsHaveTheirClosedForms) {
  EXPECT_NEAR(t_cdf(1.0, 1), 0.75, 1e-14);                                    // Cauchy: 1/2 + atan(t)/pi
  EXPECT_NEAR(chi2_cdf(3.0, 2), 1.0 - std::exp(-1.5), 1e-14);                 // exponential
  EXPECT_NEAR(f_cdf(2.0, 2, 6), 1.0 - std::pow(1.0 + 2.0 / 3.0, -3), 1e-14);  // (1 + 2 f/6)^-3
  EXPECT_NEAR(f_cdf(4.0, 1, 7), 1.0 - two_sided_p(2.0, 7), 1e-14);            // t^2 is F(1, dof)
}

TEST(Statistics, SummariesLeaveOutWhatIsNotFinite) {
  const std::vector<double> x = {1, 2, NAN, 3, 10};
  EXPECT_DOUBLE_EQ(mean(x), 4.0);
  EXPECT_DOUBLE_EQ(median(x), 2.5);
  EXPECT_NEAR(mad_scale(x), 1.0 * 1.482602218505602, 1e-12);  // distances 0.5, 0.5, 1.5, 7.5
  EXPECT_TRUE(std::isnan(mean({})));
}

TEST(Statistics, RobustMeanLeavesOutTheOddValueOnly) {
  const std::vector<double> x = {1.0, 1.1, 0.9, 1.05, 0.95, 1.02, 7.0};
  const RobustMean m = robust_mean(x);
  EXPECT_EQ(m.rejected, 1u);
  EXPECT_NEAR(m.value, 6.02 / 6, 1e-12);
  EXPECT_EQ(robust_mean(std::vector<double>{1, 2, 3, 4, 5, 6}).rejected, 0u);
}

TEST(Statistics, TruncationTakesTheVarianceOfACutNormal) {
  EXPECT_NEAR(truncated_variance(1.0), 0.2911, 1e-4);  // 1 - 2 phi(1)/(2 Phi(1) - 1)
  EXPECT_NEAR(truncated_variance(10.0), 1.0, 1e-12);
}

TEST(Statistics, AutocorrelationOfAnAlternatingSeriesAlternates) {
  const std::vector<double> r = autocorrelation(std::vector<double>{1, -1, 1, -1, 1, -1}, 2);
  EXPECT_DOUBLE_EQ(r[0], 1.0);
  EXPECT_NEAR(r[1], -5.0 / 6.0, 1e-14);
  EXPECT_NEAR(r[2], 4.0 / 6.0, 1e-14);
}

}  // namespace
}  // namespace ident
