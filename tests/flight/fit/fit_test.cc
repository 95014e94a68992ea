// The noise that a fit finds: the sensors' once, the air's for each log.
#include "ident/flight/fit/fit.h"

#include <gtest/gtest.h>

#include "ident/core/random.h"
#include "ident/flight/fit/fit_covariance.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/make_record.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/sim/simulate.h"
#include "support/open_loop_flight.h"

namespace ident {
namespace {

TEST(FlightFit, NoiseFreeFlightGivesTheConstantsBack) {
  Setting s;
  // Start 3 % off everywhere; the mass keeps its scale.
  std::vector<double> off = s.p;
  for (const int i : {param::kT, param::kQ, param::km, param::omega_m, param::Jxx, param::Jyy, param::Jzz})
    off[static_cast<std::size_t>(i)] *= 1.03;
  Vehicle v = s.vehicle;
  for (auto& [name, known] : v.parameters)
    if (name != "m") known.std = std::nullopt;
  const FlightRecord record = make_flight_record(v, off, s.logs);
  const Theta theta(off, free_constants(v, off), 1, true);
  FlightFitOptions options;
  options.estimate_noise = false;
  options.robust = false;
  NoiseModel noise = initial_noise(record);
  for (std::size_t i = 0; i < 3; ++i) noise.air[0].w_dot[i].sigma = noise.air[0].v_dot[i].sigma = 0;
  noise.q_motor = 0;
  options.noise = noise;
  options.chunk_seconds = 0.4;
  options.tolerance = 1e-14;
  const FlightFit fit = fit_flight(record, theta, options);
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    EXPECT_NEAR(theta.physical(fit.u, i) / s.p[static_cast<std::size_t>(c.index)], 1.0, 1e-8) << c.name;
  }
}

// What is left of a fall when no evaluation is worth it is taken all the same.
TEST(FlightFit, TheLastStepIsTakenWithoutAnEvaluation) {
  const Vehicle vehicle = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  const std::vector<double> p = parameter_vector(vehicle);
  SimulationOptions simulated;
  simulated.duration = 15.0;
  const std::vector<FlightLog> logs{simulate_flight(vehicle, simulated).log};
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), record.logs, true);
  FlightFitOptions options;
  const FlightFit fit = fit_flight(record, theta, options);
  FlightFit beside = fit;
  const double deviation = 1 / std::sqrt(fit.information(0, 0));  // all others held
  beside.u[0] += 0.2 * deviation;
  options.tolerance = 0.09;  // 0.04 are to be had
  finish_fit(beside, theta, options);
  EXPECT_EQ(beside.steps, fit.steps);
  EXPECT_LT((beside.u - fit.u).cwiseQuotient(fit.naive_covariance.diagonal().cwiseSqrt()).norm(), 0.01);
  EXPECT_NEAR(beside.cost, fit.cost, 0.01);
}

// A filter's position is so smooth that its differences show next to no noise.
TEST(FlightFit, AChannelWithoutNoiseDoesNotSpoilTheOthers) {
  const Vehicle vehicle = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  const std::vector<double> p = parameter_vector(vehicle);
  SimulationOptions simulated;
  simulated.duration = 20.0, simulated.turbulence = 0.3;
  simulated.noise = noise_level("typical");
  const std::vector<FlightLog> logs{simulate_flight(vehicle, simulated).log};
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  FlightRecord wrong = record;
  for (std::size_t k = 0; k < 3; ++k) wrong.sigma[kPosition + k] = 1e-8;
  const Theta theta(p, free_constants(vehicle, p), record.logs, true);
  const FlightFit fit = fit_flight(record, theta, {}), other = fit_flight(wrong, theta, {});
  for (int i = 0; i < theta.constants_count(); ++i)
    EXPECT_LT(std::abs(fit.u[i] - other.u[i]), 0.3 * std::sqrt(fit.covariance(i, i)))
        << theta.constants()[static_cast<std::size_t>(i)].name;
}

TEST(FlightFit, LongIntegrationStepsAreUsedWhereTheyMakeNoDifference) {
  const Vehicle vehicle = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  const std::vector<double> p = parameter_vector(vehicle);
  SimulationOptions simulated;
  simulated.duration = 20.0;
  FlightFitOptions cheap, dear;
  cheap.exact = dear.exact = false;
  cheap.steps = Steps::longest;
  for (const bool noisy : {true, false}) {
    simulated.noise = noise_level(noisy ? "typical" : "none");
    simulated.turbulence = noisy ? 0.3 : 0.0;
    simulated.longest_step = noisy ? simulated.longest_step : 0.0;
    const std::vector<FlightLog> logs{simulate_flight(vehicle, simulated).log};
    const FlightRecord record = make_flight_record(vehicle, p, logs);
    const Theta theta(p, free_constants(vehicle, p), record.logs, true);
    const FlightFit fit = fit_flight(record, theta, cheap), by_four = fit_flight(record, theta, dear);
    EXPECT_EQ(fit.smoother->steps() == Steps::fine, !noisy);
    for (int i = 0; i < theta.constants_count() && noisy; ++i)
      EXPECT_LT(std::abs(fit.u[i] - by_four.u[i]), 0.3 * std::sqrt(by_four.covariance(i, i)))
          << theta.name(i);
  }
}

TEST(FlightFit, ACalmLogGetsItsOwnNoiseBesideAGustyOne) {
  const Vehicle vehicle = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  SimulationOptions options;
  options.duration = 20.0;
  options.rate = 100.0;
  std::vector<FlightLog> logs;
  for (const double gusts : {0.5, 0.0}) {
    options.turbulence = gusts;
    options.seed += 1;
    logs.push_back(simulate_flight(vehicle, options).log);
  }
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), record.logs, true);
  const NoiseModel noise = fit_flight(record, theta).noise;
  ASSERT_EQ(noise.air.size(), 2u);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LT(noise.air[1].v_dot[k].sigma, 0.2 * noise.air[0].v_dot[k].sigma);
  EXPECT_GT(noise.air[0].v_dot[0].sigma, 0.0);
}

// A flight in still air, moved on by a Gauss-Markov acceleration (0.5 m/s^2, 1.5 s) that keeps its direction
// in the world, or in the body; nothing but place and speed goes with it, as the model has no drag.
FlightLog pushed(const SimulatedFlight& flight, GustAxes axes) {
  FlightLog log = flight.log;
  Random random(7);
  Eigen::Vector3d push = Eigen::Vector3d::Zero(), v = push, x = push;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    const Eigen::Matrix3d R_WB = rotation(flight.truth[i].body.q_WB);
    const Eigen::Vector3d a_W = axes == GustAxes::world ? push : R_WB * push, f_B = R_WB.transpose() * a_W;
    for (int k = 0; k < 3; ++k) {
      const auto c = static_cast<std::size_t>(k);
      log.v_W[c][i] += v[k], log.x_W[c][i] += x[k], log.f_B[c][i] += f_B[k];
    }
    if (i + 1 == log.rows()) break;
    const double h = log.t[i + 1] - log.t[i], keep = std::exp(-h / 1.5);
    x += h * v + h * h / 2 * a_W, v += h * a_W;
    for (double& one : push) one = keep * one + 0.5 * std::sqrt(1 - keep * keep) * random.normal();
  }
  return log;
}

TEST(FlightFit, TheAxesOfGustsAreFound) {
  Vehicle vehicle = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  SimulationOptions options;
  options.duration = 30.0;
  options.rate = 100.0;
  const SimulatedFlight flight = simulate_flight(vehicle, options);
  vehicle.parameters["kT"].std = 0.1 * vehicle.value("kT");
  const std::vector<double> p = parameter_vector(vehicle);
  for (const GustAxes axes : {GustAxes::world, GustAxes::body}) {
    const std::vector<FlightLog> logs{pushed(flight, axes)};
    const FlightRecord record = make_flight_record(vehicle, p, logs);
    const Theta theta(p, free_constants(vehicle, p), 1, true);
    const FlightFit fit = fit_flight(record, theta);
    EXPECT_EQ(fit.noise.axes, axes);
    for (const ColouredNoise& axis : fit.noise.air[0].v_dot) {
      EXPECT_GT(axis.sigma, 0.3);
      EXPECT_LT(axis.sigma, 0.8);
    }
    ASSERT_EQ(theta.name(0), "kT");
    EXPECT_LT(std::abs(fit.u[0]), 3.5 * std::sqrt(fit.covariance(0, 0)));
  }
}

}  // namespace
}  // namespace ident
