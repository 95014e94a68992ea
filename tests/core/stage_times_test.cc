// Time counts for the innermost stage, and the table says within which.
#include "ident/core/stage_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

namespace ident {
namespace {

const StageTime* find(const std::vector<StageTime>& all, const std::string& name, const std::string& within) {
  const auto at =
      std::ranges::find_if(all, [&](const StageTime& s) { return s.name == name && s.within == within; });
  return at == all.end() ? nullptr : &*at;
}

void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

TEST(StageTimes, TimeInsideCountsForTheInnerStageOnly) {
  {
    const Stage outer("a test");
    for (int i = 0; i < 2; ++i) {
      const Stage inner("its part");
      sleep_ms(20);
    }
    sleep_ms(5);
  }
  const std::vector<StageTime> all = stage_times();
  const StageTime *outer = find(all, "a test", ""), *inner = find(all, "its part", "a test");
  ASSERT_TRUE(outer && inner);
  EXPECT_EQ(inner->calls, 2);
  EXPECT_GE(inner->seconds, 0.04);
  EXPECT_GE(outer->seconds, 0.005);
  EXPECT_LT(outer->seconds, inner->seconds);
}

TEST(StageTimes, StagesOfThreadsDoNotNestInEachOther) {
  {
    const Stage outer("another test");
    std::thread([] { const Stage elsewhere("a thread"); }).join();
  }
  EXPECT_TRUE(find(stage_times(), "a thread", ""));
  EXPECT_FALSE(find(stage_times(), "a thread", "another test"));
}

}  // namespace
}  // namespace ident
