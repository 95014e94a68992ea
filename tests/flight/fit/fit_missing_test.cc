// What a fit makes of a flight where something strong is missing in its model.
#include <gtest/gtest.h>

#include <algorithm>

#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_steps.h"
#include "ident/flight/make_record.h"
#include "support/flight_campaign.h"
#include "support/known_quad.h"

namespace ident {
namespace {

// Two flights by a model that knows no battery, one of them on one that was down to 92 %: rotors turn slower
// than commanded by many times the noise of their speeds. A fit that begins with its constants bends them for
// it, and what that leaves passes for noise of every sensor.
TEST(FlightFit, AMissingEffectDoesNotCountAsSensorNoise) {
  const Vehicle model = testing::known(testing::quad());
  Vehicle truth = model;
  truth.battery_voltage = 8.0, truth.parameters["battery_sag.n"] = {0.6, {}};
  SimulationOptions simulated;
  simulated.battery_used = 0.02, simulated.duration = 30;
  simulated.noise.rotor_speed = 0.0015;
  std::vector<FlightLog> logs{simulate_flight(truth, simulated).log};
  truth.parameters["km"].value *= std::pow(0.92, 0.6), simulated.seed = 2;
  logs.push_back(simulate_flight(truth, simulated).log);
  const std::vector<double> p = parameter_vector(model);
  const FlightRecord record = make_flight_record(model, p, logs);
  const Theta theta(p, free_constants(model, p), record.logs, record.signals.rates);
  FlightFitOptions as_in_a_search;
  as_in_a_search.exact = as_in_a_search.fine_gusts = as_in_a_search.choose_axes = false;
  as_in_a_search.rough_noise = true, as_in_a_search.noise_rounds = 4;
  as_in_a_search.tolerance_of_misfit = 1e-4, as_in_a_search.steps = Steps::longest;
  const FlightFit fit = fit_flight(record, theta, as_in_a_search);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(fit.noise.sigma[kGyro + k], simulated.noise.gyro, 0.1 * simulated.noise.gyro);
    EXPECT_NEAR(fit.noise.sigma[kVelocity + k], simulated.noise.velocity, 0.1 * simulated.noise.velocity);
  }
}

// Whole steps fail in the rounds of noise of this flight in gusts, and what is promised there leads to a
// hundred times the value of Jp: with neither shorter steps nor a limit on those that nobody looks at,
// omega_m ended 68 deviations of the bound off.
TEST(FlightFit, ConvergesWhereFullNewtonStepsFail) {
  const flight_campaign::Outcome found =
      flight_campaign::refine_case(flight_campaign::random_case(17, {.turbulence = true}));
  const auto omega_m = std::ranges::find(found.estimates, "omega_m", &flight_campaign::Estimate::name);
  ASSERT_NE(omega_m, found.estimates.end());
  EXPECT_LT(std::abs(omega_m->value - omega_m->truth), 4 * omega_m->bound);
}

// What rounding leaves where a simulation has run away is no lower cost.
TEST(FlightFit, ANegativeSumOfSquaresIsRejected) {
  ReducedSystem system{.cost = 0.0, .fall = 1e4};
  system.g = Eigen::VectorXd::Ones(2), system.S = Eigen::MatrixXd::Identity(2, 2);
  for (const double cost : {5.0, 0.0, -1e-3}) {
    system.cost = cost;
    EXPECT_TRUE(is_finite(system)) << cost;
  }
  system.cost = -4e23, system.fall = 5e23;
  EXPECT_FALSE(is_finite(system));
}

}  // namespace
}  // namespace ident
