// Steps of a fit that are not looked at, and those of a trust region.
#include "ident/estimators/flight_fit_steps.h"

#include <gtest/gtest.h>

#include "support/open_loop_flight.h"

namespace ident {
namespace {

TEST(FlightFitSteps, OneThatChangesAConstantManyTimesIsNotTakenUnseen) {
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
TEST(FlightFitSteps, OneStepIsTakenWhereTheWholeOneFails) {
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

}  // namespace
}  // namespace ident
