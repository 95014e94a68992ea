// What counts as worse, how far residuals are trusted, and how far constants may go.
#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/random.h"
#include "ident/flight/ladder/constant_limits.h"
#include "ident/flight/ladder/error_by_speed.h"
#include "ident/flight/ladder/paired_comparison.h"
#include "ident/result/result.h"

namespace ident {
namespace {

/// Errors of one metric after 0.5 s, a window each half second.
template <class Of>
std::vector<WindowErrors> errors(std::size_t windows, Of of) {
  std::vector<WindowErrors> all;
  for (std::size_t w = 0; w < windows; ++w) {
    WindowErrors one{.arc = 0, .t = 0.5 * static_cast<double>(w)};
    for (auto& metric : one.of) metric.fill(kNaN);
    one.of[0][1] = of(w);
    all.push_back(one);
  }
  return all;
}

TEST(PairedComparison, AModelIsNotWorseThanItself) {
  const auto a = errors(40, [](std::size_t w) { return 1.0 + 0.1 * static_cast<double>(w % 7); });
  EXPECT_FALSE(worse_beyond_chance(a, a, Metric::velocity, 1, 0.01));
}

TEST(PairedComparison, ASmallErrorMoreInEveryWindowIsBeyondChance) {
  const auto a = errors(40, [](std::size_t w) { return 1.0 + 0.1 * static_cast<double>(w % 7); });
  const auto b = errors(40, [](std::size_t w) { return 1.02 + 0.1 * static_cast<double>(w % 7); });
  EXPECT_TRUE(worse_beyond_chance(b, a, Metric::velocity, 1, 0.01));
  EXPECT_FALSE(worse_beyond_chance(a, b, Metric::velocity, 1, 0.01));
}

// A test at 1 % of independent normal differences: more than 12 of 300 is beyond one chance in a thousand.
TEST(PairedComparison, EquallyGoodModelsAreSeldomCalledWorse) {
  Random random(4);
  int called = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto a = errors(60, [&](std::size_t) { return std::abs(1 + 0.2 * random.normal()); });
    const auto b = errors(60, [&](std::size_t) { return std::abs(1 + 0.2 * random.normal()); });
    called += worse_beyond_chance(a, b, Metric::velocity, 1, 0.01);
  }
  EXPECT_LE(called, 12);
}

// Errors of a race: of 15 blocks the fastest err a hundred times as much as the slowest. One and a half times
// each of them is worse, and no t test of the differences finds it at one in a thousand.
TEST(PairedComparison, WhereErrorsDifferMuchTheirRatiosTell) {
  const auto of = [](double factor) {
    return [factor](std::size_t w) { return factor * std::pow(100.0, static_cast<double>(w % 10) / 9); };
  };
  const auto a = errors(30, of(1.0)), b = errors(30, of(1.5));
  EXPECT_TRUE(worse_beyond_chance(b, a, Metric::velocity, 1, 0.001));
  EXPECT_FALSE(worse_beyond_chance(a, b, Metric::velocity, 1, 0.001));
}

TEST(PairedComparison, OfFewBlocksOnlyPlainHarmIsBeyondChance) {
  const auto a = errors(4, [](std::size_t w) { return 1.0 + 0.1 * static_cast<double>(w % 3); });
  const auto slightly = errors(4, [](std::size_t w) { return 1.3 - 0.1 * static_cast<double>(w % 3); });
  const auto plainly = errors(4, [](std::size_t w) { return 10.0 + 1.1 * static_cast<double>(w % 3); });
  EXPECT_FALSE(worse_beyond_chance(slightly, a, Metric::velocity, 1, 0.05));
  EXPECT_TRUE(worse_beyond_chance(plainly, a, Metric::velocity, 1, 0.05));
}

TEST(ErrorBySpeed, VarianceThatGrowsWithSpeedIsFound) {
  Random random(7);
  std::vector<Window> windows;
  Eigen::VectorXd residual(3 * 3000);
  for (Eigen::Index w = 0; w < 3000; ++w) {
    const double speed = 10 * static_cast<double>(w) / 3000;
    windows.push_back({.speed = speed});
    for (int k = 0; k < 3; ++k) residual[3 * w + k] = std::sqrt(0.1 + 0.04 * speed * speed) * random.normal();
  }
  const Eigen::VectorXd weight = weight_by_speed(windows, residual);
  // Cut squares lower both terms alike: their ratio stays.
  EXPECT_NEAR(weight[0] / weight[weight.size() - 1], (0.1 + 0.04 * 100) / 0.1, 0.3 * 41);
}

TEST(ConstantLimits, AMassKeepsToFiveOfItsDeviations) {
  const FreeConstant mass{
      .name = "m", .index = param::m, .positive = true, .start = 0.8, .prior_std = 0.008, .prior_value = 0.8};
  EXPECT_NEAR(0.8 * std::exp(limits_of(mass)[0]), 0.76, 1e-12);
  EXPECT_NEAR(0.8 * std::exp(limits_of(mass)[1]), 0.84, 1e-12);
}

TEST(ConstantLimits, DragDoesNotPush) {
  FreeConstant drag{.name = "rotor_drag.kd", .index = find_effect("rotor_drag")->offset, .scale = 1e-5};
  EXPECT_EQ(limits_of(drag)[0], 0.0);
  EXPECT_GT(limits_of(drag)[1], 0.0);
  drag.start = 2e-5;  // as stated
  EXPECT_NEAR(limits_of(drag)[0], -2.0, 1e-12);
}

}  // namespace
}  // namespace ident
