// Slopes of positions: exact on parabolas, as noisy as the formula says, whatever the rows between samples.
#include "ident/flight/record/velocity_of_positions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/math.h"
#include "ident/core/random.h"

namespace ident {
namespace {

TEST(VelocityOfPositions, IsExactOnAParabola) {
  std::vector<double> t, y;
  for (int i = 0; i < 400; ++i) {
    t.push_back(0.0025 * i + (i % 4 == 1 ? -0.0024 : 0.0));  // two rows almost at one time
    y.push_back(i % 4 == 0 ? 3 + 2 * t.back() - 4.9 * t.back() * t.back() : kNaN);
  }
  const std::vector<double> v = velocity_of_positions(t, y, 1e-3);
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(v[i], 2 - 9.8 * t[i], 1e-6) << i;
}

TEST(VelocityOfPositions, HasTheNoiseOfItsFormula) {
  constexpr double kNoise = 5e-4, kStep = 0.01;
  Random random(1);
  std::vector<double> t, y;
  for (int i = 0; i < 20000; ++i) t.push_back(kStep * i), y.push_back(kNoise * random.normal());
  const std::vector<double> v = velocity_of_positions(t, y, kNoise);
  double square = 0;
  for (std::size_t i = 100; i + 100 < v.size(); ++i) square += v[i] * v[i];
  const double h = std::pow(150 * kNoise * kNoise * kStep / (50.0 * 50.0), 1.0 / 7.0);
  const double expected = std::sqrt(1.5 * kNoise * kNoise * kStep / (h * h * h));
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(v.size() - 200)), expected, 0.3 * expected);
}

TEST(VelocityOfPositions, FollowsATurn) {
  std::vector<double> t, y;
  for (int i = 0; i < 1000; ++i) t.push_back(0.01 * i), y.push_back(0.5 * std::sin(3 * t.back()));
  const std::vector<double> v = velocity_of_positions(t, y, 3e-4);
  for (std::size_t i = 5; i + 5 < t.size(); ++i) EXPECT_NEAR(v[i], 1.5 * std::cos(3 * t[i]), 0.01) << i;
}

TEST(VelocityOfPositions, WithHardlyAnySamples) {
  const std::vector<double> t{0, 1, 2, 3};
  EXPECT_EQ(velocity_of_positions(t, std::vector<double>{kNaN, 1, kNaN, kNaN}, 0.1),
            std::vector<double>(4, 0.0));
  for (const double v : velocity_of_positions(t, std::vector<double>{kNaN, 1, kNaN, 5}, 0.1))
    EXPECT_NEAR(v, 2.0, 1e-4);
}

}  // namespace
}  // namespace ident
