// Estimates that no vehicle has: what is said of them, and what else counts as not known then.
#include "ident/flight/checks/implausible_estimates.h"

#include <gtest/gtest.h>

namespace ident {
namespace {

Parameter told(const std::string& name, double value, double prior) {
  Parameter p;
  p.name = name, p.value = value, p.std = 0.01 * std::abs(value), p.identifiable = true;
  p.prior_value = prior, p.prior_std = 0.1 * prior;
  return p;
}

Result with_motors(double omega_m, double zeta_m, double dead_time) {
  Result result;
  result.parameters = {
      told("omega_m", omega_m, 25), told("zeta_m", zeta_m, 1.0), told("dead_time", dead_time, 0.004),
      told("km", 900, 900),         told("Jp", 2e-6, 2e-6),      told("Jxx", 3e-3, 3e-3)};
  return result;
}

std::string not_known(const Result& result) {
  std::string names;
  for (const Parameter& p : result.parameters)
    if (!p.identifiable) names += p.name + " ";
  return names;
}

// Stated is a lag of 2 1.0/25 = 0.08 s.
TEST(FlightImpossible, MotorsThatHardlyFollowTheirCommandsAreNoMotors) {
  Result result = with_motors(0.3, 0.9, 0.004);  // 6 s
  doubt_motors_without_effect(result);
  EXPECT_TRUE(result.has_warning("motors_without_effect"));
  EXPECT_EQ(not_known(result), "omega_m zeta_m dead_time km Jxx ");
  result = with_motors(0.0, 0.0, 0.004);  // as slow as numbers go
  doubt_motors_without_effect(result);
  EXPECT_TRUE(result.has_warning("motors_without_effect"));
  result = with_motors(0.3, 0.9, 0.004);
  for (Parameter& p : result.parameters) p.prior_value.reset();
  doubt_motors_without_effect(result);
  EXPECT_TRUE(result.has_warning("motors_without_effect")) << "whatever was stated";
  result = with_motors(4, 1.9, 0.004);  // 0.95 s: slow, but there are such motors
  doubt_motors_without_effect(result);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(not_known(result), "");
}

TEST(FlightImpossible, WhatGoesWithANegativeDeadTimeIsNotKnown) {
  Result result = with_motors(25, 1.0, -0.01);
  doubt_negative_dead_time(result);
  EXPECT_TRUE(result.has_warning("negative_dead_time"));
  EXPECT_EQ(not_known(result), "omega_m zeta_m dead_time Jp ");
  result = with_motors(25, 1.0, -0.004);
  std::erase_if(result.parameters, [](const Parameter& p) { return p.name == "Jp"; });
  result.parameters.push_back(told("Jzz", 4e-3, 4e-3));
  doubt_negative_dead_time(result);
  EXPECT_EQ(not_known(result), "omega_m zeta_m dead_time Jzz ");
}

TEST(FlightImpossible, WhatIsKnownOnlyTogetherWithOneThatIsDrawnAwayIsNotKnown) {
  for (const double drawn : {9e-6, 6.3e-6}) {  // stated 6e-6 within 0.6e-6
    for (const bool told_by_flight : {false, true}) {
      Result result;
      result.parameters = {told("kT", drawn, 6e-6), told("km", 800, 900), told("Jxx", 3e-3, 3e-3)};
      result.parameters[0].identifiable = told_by_flight;
      result.correlation = {{"kT", "km", "Jxx"}, Eigen::Matrix3d::Identity()};
      result.correlation.matrix(0, 1) = result.correlation.matrix(1, 0) = -0.99;
      result.correlation.matrix(0, 2) = result.correlation.matrix(2, 0) = 0.6;
      doubt_drawn_away(result);
      EXPECT_EQ(not_known(result), told_by_flight ? "" : drawn > 8e-6 ? "kT km " : "kT ");
    }
  }
}

TEST(FlightImpossible, WhatRotorsDoAboutYawGoesWithAnInertiaThatIsDrawnAway) {
  for (const double drawn : {1e-6, 9e-6}) {  // stated 1e-5 within 1e-6
    Result result;
    result.parameters = {told("Jp", drawn, 1e-5), told("kQ", 1e-7, 1e-7), told("Jzz", 4e-3, 4e-3),
                         told("Jxx", 3e-3, 3e-3)};
    result.parameters[0].identifiable = false;
    doubt_drawn_away(result);
    EXPECT_EQ(not_known(result), drawn < 5e-6 ? "Jp kQ Jzz " : "Jp ");
  }
}

TEST(FlightImpossible, WhatPredictsWorseThanWhatItIsFarFromIsNotKnown) {
  Result result;
  result.parameters = {told("Jxx", 2e-3, 3e-3), told("Jyy", 3.1e-3, 3e-3), told("km", 800, 900)};
  result.parameters[0].pull = -6.0, result.parameters[1].pull = 4.0;
  doubt_where_worse(result, "worse");
  EXPECT_TRUE(result.has_warning("predicts_worse"));
  EXPECT_EQ(not_known(result), "Jxx ");
}

TEST(FlightImpossible, WhatTheSelfTestFoundLeavesOpenWhatDependsOnIt) {
  const auto after = [](const char* warning, void (*doubt)(Result&)) {
    Result result = with_motors(25, 1.0, 0.004);
    doubt(result);
    EXPECT_EQ(not_known(result), "") << warning;
    result.warn(warning, "");
    doubt(result);
    return not_known(result);
  };
  EXPECT_EQ(after("coarse_commands", doubt_coarse_commands), "omega_m zeta_m dead_time ");
  EXPECT_EQ(after("low_rate", doubt_seldom_speeds), "Jp Jxx ");
  EXPECT_EQ(after("contradicted", doubt_contradicted), "omega_m zeta_m dead_time km ");
}

}  // namespace
}  // namespace ident
