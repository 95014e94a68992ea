// A signal through a low-pass and back.
#include "ident/io/log/undo_low_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ident {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// sin(2 pi f t) behind a Butterworth low-pass of second order, when it has settled.
double filtered_sine(double t, double f, double cutoff) {
  const double x = f / cutoff;
  const double real = 1 - x * x, imaginary = std::numbers::sqrt2 * x;
  return std::sin(kTurn * f * t - std::atan2(imaginary, real)) / std::hypot(real, imaginary);
}

TEST(UndoLowPass, GivesBackWhatWentInUpToTheCutoff) {
  for (const double cutoff : {20.0, 80.0})
    for (const double share : {0.1, 0.3, 0.6, 1.0}) {
      const double f = share * cutoff;
      std::vector<double> t, y;
      for (int i = 0; i < 800; ++i) t.push_back(i * 1e-3), y.push_back(filtered_sine(t.back(), f, cutoff));
      ASSERT_TRUE(undo_low_pass(t, y, butterworth(cutoff)));
      double most = 0;
      for (std::size_t i = 0; i < y.size(); ++i)
        if (std::isfinite(y[i])) most = std::max(most, std::abs(y[i] - std::sin(kTurn * f * t[i])));
      EXPECT_LT(most, share < 0.5 ? 0.003 : share < 1 ? 0.01 : 0.05) << f << " of " << cutoff;
      EXPECT_LT(std::count_if(y.begin(), y.end(), [](double v) { return std::isnan(v); }), 60);
    }
}

TEST(UndoLowPass, OfSeldomSamplesMovesTheirTimes) {
  std::vector<double> t{0, 0.04, 0.08, 0.12}, y{1, 2, 3, 4};
  EXPECT_FALSE(undo_low_pass(t, y, butterworth(20)));
  EXPECT_NEAR(t[1], 0.04 - std::numbers::sqrt2 / (kTurn * 20), 1e-12);
  EXPECT_EQ(y, (std::vector<double>{1, 2, 3, 4}));
}

TEST(UndoLowPass, LeavesOutWhatLiesAtAHole) {
  std::vector<double> t, y;
  for (int i = 0; i < 200; ++i) t.push_back(i * 2.5e-3 + (i >= 100 ? 0.5 : 0)), y.push_back(1.0);
  ASSERT_TRUE(undo_low_pass(t, y, butterworth(20)));
  EXPECT_TRUE(std::isnan(y[99]) && std::isnan(y[100]));
  EXPECT_NEAR(y[50], 1.0, 1e-9);
}

TEST(UndoLowPass, TakesNothingBackWithoutACutoff) {
  std::vector<double> t{0, 1, 2}, y{1, 2, 3};
  EXPECT_FALSE(undo_low_pass(t, y, {}));
  EXPECT_EQ(t[1], 1.0);
  EXPECT_EQ(y[2], 3.0);
}

}  // namespace
}  // namespace ident
