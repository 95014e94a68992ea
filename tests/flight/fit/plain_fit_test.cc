// The fast fit against the same problem as anyone would write it with Ceres.
#include "benchmark/plain_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/fit/fit_steps.h"
#include "ident/flight/make_record.h"
#include "support/known_quad.h"

namespace ident {
namespace {

TEST(FlightFit, EndsWherePlainCeresDoes) {
  Vehicle vehicle = testing::known(testing::quad());
  for (const char* name : {"kT", "km", "Jxx", "omega_m"}) vehicle.parameters[name].value *= 1.03;
  vehicle.parameters["dead_time"].std.reset();
  // Without rotor speeds thrust and speed are known only together: along a direction that nothing but loose
  // priors tell, the cost in double precision would not say where its least is.
  vehicle.parameters["km"].std = 1e-4 * vehicle.value("km");
  FlightLog log = testing::flight(testing::quad(), 250, 4, 6);
  log.Omega.clear();
  const std::vector<double> p = parameter_vector(vehicle);
  FlightRecord record = make_flight_record(vehicle, p, std::span(&log, 1));
  record.layout.w_dot = record.layout.v_dot = -1;
  record.layout.size = kPlainState;
  const Theta theta(p, free_constants(vehicle, p), 1, false);
  ASSERT_EQ(theta.size(), kPlainShared);
  constexpr double kSegment = 1.0;
  FlightSmoother smoother(record, theta, initial_noise(record), kSegment);
  smoother.unlink();
  smoother.set_huber(1e9);
  smoother.set_exact(true);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(theta.size());
  smoother.settle(zero, 1);
  const SharedMinimum fast = minimise_shared(smoother, zero, 1e-18);
  const PlainFit plain = fit_plainly(record, theta, kSegment, 1e-18, 1);
  EXPECT_NEAR(fast.cost, plain.cost, 1e-9 * plain.cost);
  for (int i = 0; i < theta.size(); ++i)
    EXPECT_NEAR(theta.physical(fast.u, i) / theta.physical(plain.u, i), 1.0, 1e-9) << theta.name(i);
}

}  // namespace
}  // namespace ident
