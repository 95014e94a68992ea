// A residual that comes and goes is told from one that is as steady as gusts.
#include "ident/gap/statistics/steadiness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ident {
namespace {

// One log of 40 s in rows of 0.1 s: a first-order process of 0.3 s, times a factor for each row.
ResidualWrench wrench(unsigned seed, double (*factor)(double t)) {
  ResidualWrench w;
  w.names = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  w.residual = Eigen::MatrixXd::Zero(400, 6);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double carried = std::exp(-0.1 / 0.3);
  std::array<double, 6> state{};
  for (Eigen::Index k = 0; k < 400; ++k) {
    w.t.push_back(0.1 * static_cast<double>(k)), w.log.push_back(0);
    for (std::size_t c = 0; c < 6; ++c) {
      state[c] = carried * state[c] + std::sqrt(1 - carried * carried) * normal(random);
      w.residual(k, static_cast<Eigen::Index>(c)) = factor(w.t.back()) * state[c];
    }
  }
  return w;
}

TEST(Steadiness, AStationaryProcessIsWithinChance) {
  int beyond = 0;
  for (unsigned seed = 1; seed <= 200; ++seed)
    beyond += unsteady(wrench(seed, [](double) { return 1.0; })).front().deviations > 5;
  EXPECT_LE(beyond, 2) << "of 200, the furthest of five channels each";
}

TEST(Steadiness, WhatIsThereForThreeSecondsOfFortyIsNot) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Unsteady most =
        unsteady(wrench(seed, [](double t) { return t > 18 && t < 21 ? 1.0 : 0.05; })).front();
    EXPECT_GT(most.deviations, 5) << seed;
    EXPECT_DOUBLE_EQ(most.from, 18) << seed;
    EXPECT_GT(most.share, 0.8) << seed;
  }
}

}  // namespace
}  // namespace ident
