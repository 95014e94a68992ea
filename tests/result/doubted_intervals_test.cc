// What is doubted reaches to what was stated, and nothing else moves.
#include "ident/result/doubted_intervals.h"

#include <gtest/gtest.h>

namespace ident {
namespace {

TEST(DoubtedIntervals, ReachToWhatWasStated) {
  const Parameter fitted{
      .name = "omega_m", .value = 25, .std = 0.5, .ci95 = {24, 26}, .prior_value = 40, .prior_std = 3};
  std::vector<Parameter> all(4, fitted);
  all[1].doubt("no command says so"), all[2].doubt("no command says so"), all[3].identifiable = false;
  all[2].prior_value.reset(), all[3].joint = true;
  widen_doubted(all);
  EXPECT_EQ(all[0].std, 0.5);
  EXPECT_EQ(all[1].std, 15);
  EXPECT_LT(all[1].ci95[0], 0);
  EXPECT_GT(all[1].ci95[1], 40);
  for (const std::size_t kept : {0, 2, 3}) EXPECT_EQ(all[kept].ci95[1], 26) << kept;
}

TEST(DoubtedIntervals, NarrowNothing) {
  std::vector<Parameter> all{{.name = "kT", .value = 2, .std = 1, .ci95 = {-3, 7}, .prior_value = 2.1}};
  all[0].doubt({});
  widen_doubted(all);
  EXPECT_EQ(all[0].std, 1);
  EXPECT_EQ(all[0].ci95[0], -3);
}

}  // namespace
}  // namespace ident
