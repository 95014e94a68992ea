// Words for the air, and Dryden's scales behind them.
#include "ident/model/air_level.h"

#include <gtest/gtest.h>

namespace ident {
namespace {

TEST(AirLevel, EveryWordNamesTheLevelThatItIsWrittenAs) {
  for (const std::string_view word : kAirWords) {
    const auto level = air_level(word);
    ASSERT_TRUE(level) << word;
    EXPECT_EQ(word_of(*level), word);
  }
  for (const char* word : {"", "Light", "severe"}) EXPECT_FALSE(air_level(word)) << word;
}

// By hand for 15 kt = 7.717 m/s at 20 ft: sigma_w = 0.772 m/s; (0.177 + 0.01646)^0.4 = 0.5184.
TEST(AirLevel, LightIsDrydensAtFifteenKnots) {
  const GustScale light = gusts_of(AirLevel::light);
  EXPECT_NEAR(light.vertical, 0.772, 1e-3);
  EXPECT_NEAR(light.horizontal, 1.489, 2e-3);
}

TEST(AirLevel, GustsGrowFromLevelToLevelAndWithTheWind) {
  for (std::size_t i = 1; i < kAirWords.size(); ++i) {
    const GustScale less = gusts_of(static_cast<AirLevel>(i - 1)), more = gusts_of(static_cast<AirLevel>(i));
    EXPECT_LT(less.horizontal, more.horizontal) << kAirWords[i];
    EXPECT_LT(less.vertical, more.vertical) << kAirWords[i];
  }
  EXPECT_NEAR(gusts_of(AirLevel::strong).vertical, 3 * gusts_of(AirLevel::light).vertical, 1e-12);
}

}  // namespace
}  // namespace ident
