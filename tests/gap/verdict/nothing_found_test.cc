// What a verdict says where no cause was found.
#include <gtest/gtest.h>

#include "support/verdict_case.h"

namespace ident {
namespace {

using Case = VerdictCase;

TEST(NothingFound, IsNoneUnlessSomethingCanBePredictedSwingsOrStrikes) {
  Case c({"rotor_drag"}, {});
  EXPECT_EQ(c.judged().status, "none");
  EXPECT_NE(c.judged().sentence.find("its constants refitted"), std::string::npos);
  c.closes({0.0, 0.3}, 0.1);
  c.gap.after = c.gap.floor;  // nor was there much before
  EXPECT_EQ(c.judged().sentence, "The model explains these logs down to the noise; no cause stands out.");
  c.gap.after = 1.3 * c.gap.floor;
  EXPECT_EQ(c.judged().sentence,
            "The model explains these logs down to 1.3 times their noise; no cause stands out.");
  c.gap.after = c.gap.floor;
  c.jumps.push_back({"Mx", 0, 5, 5, 8.0, 3.0});
  EXPECT_EQ(c.judged().status, "unknown");
  c.jumps = {{"Mz", 0, 5, 5, 8.0, 3.0}};  // gusts do that by a drag that is known
  EXPECT_EQ(c.judged().status, "none");
  EXPECT_NE(c.judged().sentence.find("Moments about the yaw axis jump, most at 3 s of log 1"),
            std::string::npos)
      << c.judged().sentence;
  c.jumps = {{"Mx", 0, 5, 1, 8.0, 3.0}};  // the error of measured speeds does that
  EXPECT_EQ(c.judged().status, "none");
  EXPECT_NE(c.judged().sentence.find("Mx jumps, most at 3 s of log 1, by no more than a sudden drive"),
            std::string::npos)
      << c.judged().sentence;
  c.jumps.clear();
  c.lines.push_back({"az", 36.0, 20.0, 0.3});
  EXPECT_EQ(c.judged().status, "unknown");
  c.lines.clear();
  c.rival.gain[2] = 40.0;
  EXPECT_EQ(c.judged().status, "none");
  c.rival.sensors.emplace_back("r", 20.0);
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "unknown");
  EXPECT_NE(seen.sentence.find("Fz"), std::string::npos) << seen.sentence;
}

TEST(NothingFound, AContradictedBenchValueIsAGap) {
  Case c({"parameter:kT"}, {});
  c.contradicts_kT(6.0);
  const Judged seen = c.judged();
  EXPECT_EQ(seen.status, "unknown");
  EXPECT_NE(seen.sentence.find("kT"), std::string::npos) << seen.sentence;
  c.contradicts_kT(4.0);
  const Judged doubted = c.judged();
  EXPECT_EQ(doubted.status, "none");
  EXPECT_NE(doubted.sentence.find("kT by 4.0 standard deviations"), std::string::npos) << doubted.sentence;
  c.contradicts_kT(2.0);
  EXPECT_NE(c.judged().sentence.find("within what was stated"), std::string::npos);
}

}  // namespace
}  // namespace ident
