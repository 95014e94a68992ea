// Causes whose size in the full fit is none, or beyond any vehicle, are not named.
#include "ident/gap/verdict/impossible_size.h"

#include <gtest/gtest.h>

#include "support/verdict_case.h"

namespace ident {
namespace {

Parameter fitted(const std::string& name, double value, double std, const std::string& unit) {
  Parameter p;
  p.name = name, p.value = value, p.std = std, p.unit = unit;
  return p;
}

TEST(ImpossibleSize, ACauseOfWhichNothingIsLeftIsNotNamed) {
  VerdictCase c({"sensor_delay"}, {"sensor_delay"});
  c.weighs({0}, 1.0);
  c.fitted = {fitted("sensor_delay.tau", 4e-3, 5e-4, "s")};
  EXPECT_EQ(c.judged().status, "identified");
  c.fitted = {fitted("sensor_delay.tau", 2e-6, 5e-4, "s")};
  const Judged none = c.judged();
  EXPECT_EQ(none.status, "unknown");
  EXPECT_NE(none.sentence.find("nothing is left of sensor_delay"), std::string::npos) << none.sentence;
}

TEST(ImpossibleSize, FromTheValueWithoutTheCause) {
  VerdictCase c({"motor_asymmetry"}, {"motor_asymmetry"});
  c.fitted = {fitted("motor_asymmetry.ratio", 1.01, 0.02, "-")};
  EXPECT_FALSE(impossible_size(c.search, c.fitted).empty());
  c.fitted = {fitted("motor_asymmetry.ratio", 0.8, 0.02, "-")};
  EXPECT_TRUE(impossible_size(c.search, c.fitted).empty());
}

TEST(ImpossibleSize, APayloadIsOnTheVehicle) {
  VerdictCase c({"payload"}, {"payload"});
  const auto at = [&](double z) {
    c.fitted = {fitted("payload.m", 0.05, 0.001, "kg"), fitted("payload.x", 0.02, 0.001, "m"),
                fitted("payload.z", z, 0.01, "m")};
    return impossible_size(c.search, c.fitted);
  };
  EXPECT_TRUE(at(0.1).empty());
  EXPECT_NE(at(12.0).find("12 m from the vehicle"), std::string::npos);
}

}  // namespace
}  // namespace ident
