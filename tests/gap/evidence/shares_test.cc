// Shapley values: what they owe by their axioms, and a case worked out by hand.
#include "ident/gap/evidence/shares.h"

#include <gtest/gtest.h>

#include <numeric>

namespace ident {
namespace {

TEST(Shares, AddUpToWhatAllCausesClose) {
  const std::vector<double> errors{10, 7, 6, 2, 9, 5, 4, 1};
  const std::vector<double> shares = shapley_values(errors);
  EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), errors[0] - errors[7], 1e-12);
}

TEST(Shares, ACauseThatNeverHelpsHasNone) {
  // Bit 1 changes nothing.
  const std::vector<double> shares = shapley_values({10, 4, 10, 4});
  EXPECT_NEAR(shares[0], 6, 1e-12);
  EXPECT_NEAR(shares[1], 0, 1e-12);
}

TEST(Shares, CausesThatDoTheSameHaveTheSame) {
  // Each alone takes 8 of 10 away, both together 9: (8 + 1)/2 each.
  const std::vector<double> shares = shapley_values({10, 2, 2, 1});
  EXPECT_NEAR(shares[0], 4.5, 1e-12);
  EXPECT_NEAR(shares[1], 4.5, 1e-12);
}

TEST(Shares, OfOneCauseIsAllThatItCloses) { EXPECT_NEAR(shapley_values({10, 3})[0], 7, 1e-12); }

}  // namespace
}  // namespace ident
