// Summed periodograms: of a tone, of noise whose variance is known, and of what is constant.
#include "ident/core/periodograms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace ident {
namespace {

TEST(Periodograms, AToneLiesInItsEntryAndThoseBesideIt) {
  Periodograms p(64);
  std::vector<double> x(64);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = 3.0 * std::cos(2 * std::numbers::pi * 10 * static_cast<double>(i) / 64 + 0.4);
  p.add(x, 0.0);
  p.add(x, 0.0);
  EXPECT_DOUBLE_EQ(p.count(), 2);
  ASSERT_EQ(p.power().size(), 33u);
  // Half the amplitude, half the mean of the window, 64 samples; a quarter of its power on either side.
  EXPECT_NEAR(p.power()[10], 2 * std::pow(3.0 / 2 * 0.5 * 64, 2), 1e-9);
  EXPECT_NEAR(p.power()[9], p.power()[10] / 4, 1e-9);
  EXPECT_NEAR(p.power()[11], p.power()[10] / 4, 1e-9);
  EXPECT_NEAR(p.power()[20], 0, 1e-9);
}

TEST(Periodograms, NoiseOfAVarianceHasItTimesTheWeight) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, 2.0);
  Periodograms p(32);
  std::vector<double> x(32);
  for (int k = 0; k < 20000; ++k) {
    for (double& v : x) v = normal(random);
    p.add(x, 0.0);
  }
  for (std::size_t f = 1; f < 16; ++f)  // each known to 1/sqrt(20000)
    EXPECT_NEAR(p.power()[f] / (p.count() * p.weight()), 4.0, 5 * 4.0 / std::sqrt(20000.0)) << f;
}

TEST(Periodograms, TheLevelIsTakenBeforeTheWindow) {
  Periodograms p(16);
  p.add(std::vector<double>(16, 7.0), 7.0);
  for (const double power : p.power()) EXPECT_EQ(power, 0.0);
}

}  // namespace
}  // namespace ident
