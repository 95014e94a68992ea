// The second term of the thrust curve against T = a + b Omega + c Omega^2 of a thrust stand.
#include "ident/effects/thrust_curve.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace ident {
namespace {

double thrust(double x, double c, double offset) {  // over that at hover, x = Omega/Omega_hover
  const double per_hover = 1.0;
  const std::array p{c, offset};
  RotorSeam<double> seam{.per_Omega_hover = &per_hover, .Omega = x, .T = x * x};
  ThrustCurve::apply(p.data(), seam);
  return seam.T;
}

// a + b x + d x^2 with a + b + d = 1, over x^2: slope c = -b - 2 a at 1, half of its curvature 3 a + b = a -
// c.
TEST(ThrustCurve, FollowsAStandsSecondOrderCurve) {
  const double a = 0.08, b = -0.05, d = 1 - a - b, c = -b - 2 * a;
  const auto missed = [&](double x, double offset) {
    return std::abs(thrust(x, c, offset) - (a + b * x + d * x * x));
  };
  for (const double x : {0.7, 0.85, 1.2, 1.5}) {
    EXPECT_LT(missed(x, a - c), 0.4 * missed(x, 0)) << x;
    EXPECT_GT(missed(x, c - a), missed(x, 0)) << x;
  }
}

TEST(ThrustCurve, LeavesHoverAndARotorAtRestAlone) {
  EXPECT_DOUBLE_EQ(thrust(1.0, 0.2, 0.1), 1.0);
  EXPECT_DOUBLE_EQ(thrust(0.0, 0.2, 0.1), 0.0);
}

}  // namespace
}  // namespace ident
