// When the motors' lag is held where it was stated, on quadratic forms made by hand.
#include "ident/gap/search/wrong_lag.h"

#include <gtest/gtest.h>

#include "support/standing_by_hand.h"

namespace ident {
namespace {

// A bias that gains `gain`, with unit information.
Standing a_bias_that_gains(double gain, const std::string& cause = "imu_bias") {
  Standing at = standing_by_hand({"m", "imu_bias.ax"}, Eigen::VectorXd{{1.0, 1.0}},
                                 Eigen::VectorXd{{0.0, std::sqrt(gain)}});
  at.problem.constants[1].scale = 1e-3;  // far from what is physical
  at.problem.candidates = {{cause, {1}}};
  return at;
}

TEST(WrongLag, IsHeldWhereAnotherCauseGainsMoreByItThanItCosts) {
  const Standing held = a_bias_that_gains(500), at_hand = a_bias_that_gains(50);
  EXPECT_TRUE(shows_more(held, at_hand, 400));
  EXPECT_FALSE(shows_more(held, at_hand, 500));
  EXPECT_FALSE(shows_more(held, a_bias_that_gains(450), 100));
}

TEST(WrongLag, IsNotHeldForItselfNorForWhatIsHardlySeen) {
  EXPECT_FALSE(
      shows_more(a_bias_that_gains(500, "parameter:zeta_m"), a_bias_that_gains(0, "parameter:zeta_m"), 0));
  EXPECT_FALSE(shows_more(a_bias_that_gains(90), a_bias_that_gains(0), 0));
}

}  // namespace
}  // namespace ident
