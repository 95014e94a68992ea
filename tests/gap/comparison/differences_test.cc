// Differences of constants between two fits, from values and covariances made by hand.
#include "ident/gap/comparison/differences.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// kT, km and a drag that a side names. Flight tells kT km^2 to 0.1 % and the drag to 2e-6; kT and km are
// stated to 3 %.
ComparedFit fit_of(double kT, double km, double kd) {
  const double stated = 0.03, flight = 0.001;
  MatrixXd prior = MatrixXd::Zero(3, 3), data = MatrixXd::Zero(3, 3);  // information
  prior(0, 0) = prior(1, 1) = 1 / (stated * stated);
  const Eigen::Vector3d product(1, 2, 0);  // kT km^2, in shares
  data += product * product.transpose() / (flight * flight);
  data(2, 2) = 1 / (2e-6 * 2e-6);
  const MatrixXd C = (prior + data).inverse();
  ComparedFit out{.names = {{"kT", ""}, {"km", ""}, {"rotor_drag.kd", "rotor_drag"}},
                  .covariance = C,
                  .response = MatrixXd::Identity(3, 3) - C * prior};
  // Both around 1: the estimate moves from the statement as far as the data make it.
  out.value = Eigen::Vector3d(1, 1, 0) + out.response * Eigen::Vector3d(kT - 1, km - 1, kd);
  return out;
}

const ComparedCause& cause(const std::vector<ComparedCause>& all, const std::string& name) {
  return *std::ranges::find(all, name, &ComparedCause::name);
}

std::vector<std::string> named(const std::vector<ComparedCause>& all) {
  std::vector<std::string> out;
  for (const ComparedCause& one : all)
    if (one.differs) out.push_back(one.name);
  return out;
}

const ComparisonRules kDrag{.material = {"rotor_drag"}};

TEST(Differences, OfEqualVehiclesThereIsNone) {
  const ComparedFit one = fit_of(1.02, 0.99, 6e-5);
  EXPECT_TRUE(named(differences(one, one, kDrag)).empty());
}

TEST(Differences, OfAnEffectThatOneSideLacksTheSizeIsTold) {
  const auto found = differences(fit_of(1, 1, 6e-5), fit_of(1, 1, 0), kDrag);
  ASSERT_EQ(named(found), std::vector<std::string>{"rotor_drag"});
  const ComparedConstant& kd = cause(found, "rotor_drag").constants.front();
  EXPECT_NEAR(kd.difference, 6e-5, 1e-12);
  EXPECT_NEAR(kd.std, std::sqrt(2.0) * 2e-6, 1e-12);  // by (1)
}

TEST(Differences, AnEffectWithoutAMaterialShareIsNone) {
  EXPECT_TRUE(named(differences(fit_of(1, 1, 6e-5), fit_of(1, 1, 0), {})).empty());
}

// Only kT km^2 is seen: 8 % of kT is 4 % of km, and rounding decides which of the two is told first.
TEST(Differences, WhatOnlyAProductTellsHasAnAlternative) {
  const auto found = differences(fit_of(1.08, 1, 0), fit_of(1, 1, 0), kDrag);
  ASSERT_EQ(named(found).size(), 1U);
  const bool is_kT = named(found).front() == "parameter:kT";
  const ComparedCause& told = cause(found, is_kT ? "parameter:kT" : "parameter:km");
  EXPECT_EQ(told.alternatives, std::vector<std::string>{is_kT ? "parameter:km" : "parameter:kT"});
  EXPECT_NEAR(told.constants.front().difference, is_kT ? 0.08 : 0.04, 1e-6);
}

TEST(Differences, WhereSomethingUnknownActsConstantsTakeItsPlace) {
  const ComparisonRules unknown{.material = {"rotor_drag"}, .constants = false};
  EXPECT_TRUE(named(differences(fit_of(1.08, 1, 0), fit_of(1, 1, 0), unknown)).empty());
}

// 1 % over all looks; the prior is counted twice, which only makes it less. 4 standard errors of 4000: 1.7 %.
TEST(Differences, ChanceNamesNothingInNinetyNineOfAHundred) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int wrong = 0;
  for (int i = 0; i < 4000; ++i) {
    ComparedFit real = fit_of(1, 1, 6e-5), simulated = real;
    const MatrixXd L = real.covariance.llt().matrixL();
    for (ComparedFit* side : {&real, &simulated})
      side->value += L * Eigen::Vector3d(normal(random), normal(random), normal(random));
    wrong += named(differences(real, simulated, kDrag)).empty() ? 0 : 1;
  }
  EXPECT_LT(wrong, 68);
}

TEST(Differences, WhatOneSideDoesNotHaveIsNotCompared) {
  ComparedFit simulated = fit_of(1, 1, 0);
  simulated.names[2].constant = "parasitic_drag.C";
  EXPECT_EQ(differences(fit_of(1, 1, 6e-5), simulated, kDrag).size(), 2U);
}

}  // namespace
}  // namespace ident
