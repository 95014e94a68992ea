// The simulator repeats itself, and shows what it says it shows.
#include "ident/sim/simulate.h"

#include <gtest/gtest.h>

#include "support/random_vehicle.h"

namespace ident {
namespace {

SimulationOptions quick(const std::string& scenario, double duration) {
  SimulationOptions options;
  options.scenario = scenario;
  options.duration = duration;
  return options;
}

/// The first random vehicle whose motors are quick enough for any scenario.
Vehicle agile_vehicle() {
  for (std::uint64_t seed = 1;; ++seed)
    if (const Vehicle v = random_vehicle(seed); v.value("omega_m") > 30) return v;
}

TEST(Simulate, OneHundredRandomVehiclesFlyTheMixedScenario) {
  SimulationOptions options = quick("mixed", 40);
  options.longest_step = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    const SimulatedFlight flight = simulate_flight(vehicle, options);
    EXPECT_GT(flight.lowest, 0.2) << vehicle.name;
    EXPECT_LT(flight.furthest, 0.8) << vehicle.name;
  }
}

TEST(Simulate, TheSameSeedGivesTheSameLogAndAnotherSeedAnotherOne) {
  SimulationOptions options = quick("mixed", 5);
  const Vehicle vehicle = agile_vehicle();
  const FlightLog a = simulate_flight(vehicle, options).log, b = simulate_flight(vehicle, options).log;
  options.seed = 2;
  const FlightLog c = simulate_flight(vehicle, options).log;
  EXPECT_EQ(a.w_B, b.w_B);
  EXPECT_EQ(a.delta, b.delta);
  EXPECT_NE(a.delta, c.delta);
}

TEST(Simulate, WithoutNoiseTheLogShowsTheTruth) {
  SimulationOptions options = quick("steps", 4);
  options.noise = noise_level("none");
  const SimulatedFlight flight = simulate_flight(agile_vehicle(), options);
  ASSERT_EQ(flight.truth.size(), flight.log.rows());
  for (std::size_t i = 0; i < flight.truth.size(); i += 50) {
    EXPECT_EQ(flight.log.w_B[1][i], flight.truth[i].body.w_B[1]);
    EXPECT_EQ(flight.log.x_W[0][i], flight.truth[i].body.x_W[0]);
    EXPECT_EQ(flight.log.Omega[2][i], flight.truth[i].motors[2].Omega);
  }
}

TEST(Simulate, AControllerThatFliesByTheGyroAnswersItsNoise) {
  SimulationOptions options = quick("steps", 2);
  const Vehicle vehicle = agile_vehicle();
  for (const char* noise : {"typical", "none"}) {
    options.noise = noise_level(noise);
    options.noise.gyro_bias = 0.2;  // is known to it
    options.by_gyro = false;
    const SimulatedFlight by_truth = simulate_flight(vehicle, options);
    options.by_gyro = true;
    const SimulatedFlight by_gyro = simulate_flight(vehicle, options);
    EXPECT_EQ(by_gyro.log.w_B[0][0], by_truth.log.w_B[0][0]);
    double apart = 0;
    for (std::size_t i = 0; i < by_truth.log.rows(); ++i)
      apart = std::max(apart, std::abs(by_gyro.log.delta[0][i] - by_truth.log.delta[0][i]));
    EXPECT_EQ(apart > 1e-3, noise == std::string("typical")) << apart;
  }
}

}  // namespace
}  // namespace ident
