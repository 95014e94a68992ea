// Steps of a fit that are not looked at, and those of a trust region.
#include "ident/flight/fit/fit_steps.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "ident/flight/fit/fit_noise.h"
#include "support/open_loop_flight.h"

namespace ident {
namespace {

TEST(FlightFitSteps, ALongStepIsEvaluatedBeforeItIsTaken) {
  const Setting s;
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(s.theta.size());
  Eigen::VectorXd du = Eigen::VectorXd::Constant(s.theta.size(), 0.5);
  EXPECT_TRUE(is_short(s.theta, start, du));
  for (const double change : {1.5, -1.5, kNaN}) {
    du[2] = change;
    EXPECT_FALSE(is_short(s.theta, start, du)) << s.theta.name(2) << " by " << change;
  }
}

// Where the whole step of Newton's leads too far, the one that was asked for is a shorter one.
TEST(FlightFitSteps, AShorterStepIsTakenWhereTheNewtonStepFails) {
  const Setting s;
  for (const int unknown : {2, 5, 7}) {
    Eigen::VectorXd far = Eigen::VectorXd::Zero(s.theta.size());
    far[unknown] = -1;  // a third and less of what it is
    FlightSmoother smoother(s.record, s.theta, initial_noise(s.record), 0.2);
    smoother.settle(far, 2);
    const double before = smoother.linearize(far).cost + s.theta.prior(far).residual.squaredNorm();
    smoother.accept();
    const SharedMinimum at =
        by_trust_region(smoother, far, {.tolerance = 0.1, .near = kNear, .max_steps = 1});
    EXPECT_GE(at.steps, 2) << s.theta.name(unknown);  // the whole one first
    EXPECT_LT(at.cost, 0.9 * before) << s.theta.name(unknown);
  }
}

// Less than nothing of a sum of squares is no minimum: a real flight's steps ended with -1e58 of a fall of
// 1e71.
TEST(FlightFitSteps, ADivergedSimulationHasNoCost) {
  ReducedSystem system{.cost = 4e5, .fall = 7.5e13, .g = Eigen::VectorXd::Zero(2)};
  system.S = Eigen::MatrixXd::Identity(2, 2);
  EXPECT_TRUE(is_finite(system));
  system.cost = -1e-9, system.fall = 1e-3;  // of exact logs
  EXPECT_TRUE(is_finite(system));
  for (const auto& [cost, fall] :
       {std::pair{-1e58, 1.8e71}, {-6e43, 7.8e47}, {1e20, 1e35}, {-1.0, 10.0}, {kNaN, 1.0}}) {
    system.cost = cost, system.fall = fall;
    EXPECT_FALSE(is_finite(system)) << cost << ' ' << fall;
  }
}

// Three that are known as a and b c only, so well that the last digits of what is told of them outweigh what
// was known of b before.
TEST(FlightFitSteps, RoundingErrorsDoNotCountAsInformation) {
  const Eigen::Vector3d a(1, 0, 0), bc(0.1, 1, 1);
  Eigen::MatrixXd information = 1e22 * (a * a.transpose() + bc * bc.transpose());
  information(1, 1) *= 1 + 1e-12;
  Eigen::MatrixXd prior = Eigen::Vector3d(1e2, 1e4, 1e-2).asDiagonal();
  const Posterior all = posterior(information, prior);
  EXPECT_NEAR(std::sqrt(all.covariance(1, 1)), 1e-2, 1e-5);
  EXPECT_NEAR(std::sqrt(all.covariance(2, 2)), 1e-2, 1e-5);
  EXPECT_NEAR(all.covariance(1, 2), -1e-4, 1e-7);
  EXPECT_LT(std::sqrt(all.covariance(0, 0)), 1e-8);
  EXPECT_LT((all.information - all.information.transpose()).norm(), 1e-9 * all.information.norm());
  EXPECT_NEAR(all.information(0, 0), information(0, 0), 1e-9 * information(0, 0));
  // Where two directions are not told, b against c and d, whatever the scale of the others.
  for (const double much : {1e14, 1e18, 1e22}) {
    const Eigen::Vector4d one(1, 0, 0, 0), e(0, 1, 1, std::sqrt(1e-2 / much));
    const Posterior two =
        posterior(much * (one * one.transpose() + e * e.transpose()), 1e-2 * Eigen::MatrixXd::Identity(4, 4));
    EXPECT_NEAR(two.covariance(1, 1), 50.0, 1.0) << much;
    EXPECT_NEAR(two.covariance(3, 3), 100.0, 51.0) << much;
    EXPECT_GT(two.covariance(0, 0), 0.0) << much;
  }
  // What is no rounding stays.
  const Eigen::MatrixXd told = Eigen::Vector3d(4.0, 9.0, 1e-4).asDiagonal();
  EXPECT_NEAR((posterior(told, prior).covariance - (told + prior).inverse()).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace ident
