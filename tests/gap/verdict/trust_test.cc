// Probabilities of causes after a verdict: those not named, and those that are there whatever else is.
#include "ident/gap/verdict/trust.h"

#include <gtest/gtest.h>

#include "support/verdict_case.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

Json candidates() {
  return Json::array({{{"effect", "imu_bias"}, {"probability", 1.0}},
                      {{"effect", "wind"}, {"probability", 0.5}},
                      {{"effect", "battery_sag"}, {"probability", 0.1}}});
}

TEST(Trust, WhatIsNotNamedIsWorthLess) {
  Json all = candidates();
  trust_less(all, {"battery_sag"});
  EXPECT_EQ(all[0]["effect"], "imu_bias");
  EXPECT_DOUBLE_EQ(all[0]["probability"].get<double>(), Judged::kNearestIsThere);
  EXPECT_DOUBLE_EQ(all[2]["probability"].get<double>(), 0.1) << all;
}

TEST(Trust, WhatIsThereWhateverElseIsComesFirst) {
  Json all = candidates();
  trust_less(all, {"battery_sag"});
  trust_more(all, {"battery_sag"});
  EXPECT_EQ(all[0]["effect"], "battery_sag");
  EXPECT_GT(all[0]["probability"].get<double>(), 0.9);
  all[0]["probability"] = 1.0;
  trust_more(all, {"battery_sag"});
  EXPECT_DOUBLE_EQ(all[0]["probability"].get<double>(), 1.0) << "never less than before";
}

// A battery that thrust shows in every log, among causes that do not explain the rest.
TEST(Trust, ABatteryThatThrustShowsIsPlain) {
  VerdictCase c({"imu_bias", "battery_sag"}, {"imu_bias", "battery_sag"});
  c.weighs({0}, 0.9);
  c.weighs({0, 1}, 0.1);
  EXPECT_FALSE(c.judged().plain);
  c.closes({0.0, 0.6}, 0.3);
  c.rival.gain[0] = 1000.0;
  EXPECT_EQ(c.judged().status, "unknown") << c.judged().sentence;
  c.search.thrust = {
      .stretches = 20, .logs = 2, .rising = 2, .n = 0.8, .n_std = 0.1, .varies = 0.05, .left = 0.01};
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "identified") << seen.sentence;
  EXPECT_EQ(seen.effects, std::vector<std::string>{"battery_sag"});
  EXPECT_TRUE(seen.plain);
}

}  // namespace
}  // namespace ident
