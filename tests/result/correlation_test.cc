// Parts of correlations, and two side by side.
#include "ident/result/correlation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ident {
namespace {

TEST(Correlation, WhatIsNotInItIsIndependent) {
  const Correlation c{{"kT", "km"}, Eigen::Matrix2d{{1, -0.9}, {-0.9, 1}}};
  EXPECT_EQ(c.of("kT", "km"), -0.9);
  EXPECT_EQ(c.of("km", "kT"), -0.9);
  EXPECT_EQ(c.of("kT", "kQ"), 0.0);
  EXPECT_EQ(c.of("kQ", "kQ"), 1.0);
}

TEST(Correlation, APartKeepsItsPairs) {
  const Correlation c{{"a", "b", "c"}, Eigen::Matrix3d{{1, 0.1, 0.2}, {0.1, 1, 0.3}, {0.2, 0.3, 1}}};
  const Correlation part = c.part([](const std::string& name) { return name != "b"; });
  EXPECT_EQ(part.names, (std::vector<std::string>{"a", "c"}));
  EXPECT_EQ(part.matrix, (Eigen::Matrix2d{{1, 0.2}, {0.2, 1}}));
}

TEST(Correlation, WhatIsNotANumberIsNothingKnown) {
  const Correlation c{{"a", "b", "c"}, Eigen::Matrix3d{{1, 0.1, NAN}, {0.1, 1, NAN}, {NAN, NAN, NAN}}};
  const Correlation part = c.part([](const std::string&) { return true; });
  EXPECT_EQ(part.names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(part.of("a", "b"), 0.1);
}

TEST(Correlation, TwoSideBySideKnowNothingOfEachOther) {
  const Correlation one{{"a", "b"}, Eigen::Matrix2d{{1, 0.5}, {0.5, 1}}};
  const Correlation both = one.beside({{"c"}, Eigen::MatrixXd::Ones(1, 1)}).beside({});
  EXPECT_EQ(both.matrix, (Eigen::Matrix3d{{1, 0.5, 0}, {0.5, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(Correlation{}.beside(one).of("a", "b"), 0.5);
}

}  // namespace
}  // namespace ident
