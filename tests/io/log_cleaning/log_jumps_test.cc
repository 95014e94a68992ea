// Estimators that are reset in flight, and such that correct themselves all the time.
#include "ident/io/log_cleaning/log_jumps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/random.h"

namespace ident {
namespace {

struct Path {
  FlightLog log;
  std::vector<std::vector<double>> x = std::vector<std::vector<double>>(3);

  explicit Path(double interval = 0.01) {
    Random random(7);
    log.file = "log.csv";
    for (int i = 0; i < 3000; ++i) {
      const double t = interval * i;
      log.t.push_back(t);
      for (std::size_t k = 0; k < 3; ++k)
        x[k].push_back(2 * std::sin((0.7 + 0.3 * static_cast<double>(k)) * t) + 0.003 * random.normal());
    }
  }
  void move(std::size_t from, std::size_t to, double by) {
    for (std::size_t i = from; i < to; ++i) x[0][i] += by, x[2][i] -= 0.5 * by;
  }
};

TEST(LogJumps, APathWithoutJumpsIsLeftAlone) {
  Path path;
  const auto before = path.x;
  split_at_jumps(path.log, path.x, "x y z");
  EXPECT_EQ(path.x, before);
  EXPECT_TRUE(path.log.breaks.empty());
  EXPECT_TRUE(path.log.warnings.empty());
}

TEST(LogJumps, AResetSplitsTheFlight) {
  Path path;
  path.move(1200, 3000, 0.8);
  path.log.breaks = {20.0};
  const auto before = path.x;
  split_at_jumps(path.log, path.x, "x y z");
  EXPECT_EQ(path.x, before);
  EXPECT_EQ(path.log.breaks, (std::vector{path.log.t[1199], 20.0}));
  ASSERT_EQ(path.log.warnings.size(), 1U);
  EXPECT_EQ(path.log.warnings[0].code, "jumps");
  EXPECT_NE(path.log.warnings[0].message.find("1 in all, first at t = 11.99 s"), std::string::npos)
      << path.log.warnings[0].message;
}

TEST(LogJumps, AwayAndBackCountsAsNotSampled) {
  Path path;
  path.move(1200, 1230, 0.8);
  path.move(2000, 2200, 0.8);  // longer than a second: who knows which part is right
  split_at_jumps(path.log, path.x, "x y z");
  for (std::size_t i = 1190; i < 1240; ++i) EXPECT_EQ(std::isnan(path.x[1][i]), i >= 1200 && i < 1230) << i;
  EXPECT_FALSE(std::isnan(path.x[0][2100]));
  EXPECT_EQ(path.log.breaks, (std::vector{path.log.t[1999], path.log.t[2199]}));
}

// Positions that a slower sensor pulls back with every sample it has: only what stands out is a reset.
TEST(LogJumps, CorrectionsAllTheTimeAreNoResets) {
  Path path;
  for (std::size_t i = 0; i < 3000; i += 20)
    path.move(i, 3000, (i / 20 % 3 == 0 ? -0.4 : 0.2) * (1 + 0.1 * std::sin(static_cast<double>(i))));
  Path also = path;
  also.move(1205, 1230, 30.0);
  split_at_jumps(path.log, path.x, "x y z");
  EXPECT_TRUE(path.log.breaks.empty() && path.log.warnings.empty());
  split_at_jumps(also.log, also.x, "x y z");
  EXPECT_TRUE(also.log.breaks.empty());
  EXPECT_TRUE(std::isnan(also.x[0][1210]));
}

TEST(LogJumps, WhereSamplesAreFarApartNothingIsSaid) {
  Path path;
  path.move(1200, 3000, 0.8);
  for (std::size_t i = 1200; i < 3000; ++i) path.log.t[i] += 2.0;
  split_at_jumps(path.log, path.x, "x y z");
  EXPECT_TRUE(path.log.breaks.empty());
}

}  // namespace
}  // namespace ident
