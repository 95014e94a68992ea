// Attitudes, velocities and positions of estimators: seen in the log alone, estimated with the flight, no
// gap.
#include "ident/flight/conditioning/estimator_drift.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ident/effects/catalogue.h"
#include "ident/flight/fit/fit.h"
#include "ident/flight/make_record.h"
#include "ident/flight/refine.h"
#include "support/diagnosed.h"
#include "support/slow_errors.h"

namespace ident {
namespace {

constexpr ColouredNoise kError{0.008, 6.0};

SimulatedFlight flown(const Vehicle& vehicle, std::uint64_t seed, double seconds = 60.0) {
  SimulationOptions options;
  options.duration = seconds, options.rate = 100.0, options.seed = seed, options.turbulence = 0.5;
  return simulate_flight(vehicle, options);
}

FlightRecord record_of(const Vehicle& vehicle, const FlightLog& log) {
  const std::vector<FlightLog> logs{log};
  return make_flight_record(vehicle, parameter_vector(vehicle), logs);
}

bool drifts(const FlightRecord& record, ShownGroup group = kShownAttitude) {
  return record.layout.shown_error[group] >= 0;
}

bool any_drifts(const FlightRecord& record) {
  return drifts(record, kShownAttitude) || drifts(record, kShownVelocity) || drifts(record, kShownPosition);
}

TEST(SlowErrors, AreFoundInTheLogAndReportedOnce) {
  const Vehicle vehicle = testing::published_vehicle();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    FlightLog log = flown(vehicle, seed).log;
    EXPECT_FALSE(drifts(record_of(vehicle, log))) << seed;
    testing::drift_attitude(log, kError, seed);
    const FlightRecord record = record_of(vehicle, log);
    ASSERT_TRUE(drifts(record)) << seed;
    const auto told = std::ranges::count(record.warnings, "slow_errors", &Warning::code);
    EXPECT_EQ(told, 1) << seed;
    for (const ColouredNoise& axis : record.slow[kShownAttitude]) {  // its density is that, more or less
      const double density = axis.sigma * axis.sigma / axis.tau;
      EXPECT_NEAR(std::log(density / (kError.sigma * kError.sigma / kError.tau)), 0.0, 0.8) << seed;
    }
  }
}

// Velocities against forces and positions; what is off by itself is not taken for another.
TEST(SlowErrors, OfDifferentSensorsAreSeparated) {
  const Vehicle vehicle = testing::published_vehicle();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    FlightLog fast = flown(vehicle, seed).log, far = fast;
    testing::drift(fast.v_W, fast.t, {0.08, 5.0}, seed);
    EXPECT_TRUE(drifts(record_of(vehicle, fast), kShownVelocity)) << seed;
    testing::drift(far.x_W, far.t, {0.3, 8.0}, seed);
    EXPECT_TRUE(drifts(record_of(vehicle, far), kShownPosition)) << seed;
    EXPECT_FALSE(drifts(record_of(vehicle, far), kShownVelocity)) << seed;
    EXPECT_FALSE(drifts(record_of(vehicle, far), kShownAttitude)) << seed;
  }
}

// Large white noise of an attitude that is sampled often sums up in the body's own frame, and is not slow.
TEST(SlowErrors, AreNotTheWhiteNoiseOfAnAttitudeThatTurns) {
  const Vehicle vehicle = testing::published_vehicle();
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SimulationOptions options;
    options.duration = 45.0, options.rate = 400.0, options.seed = seed;
    options.noise.attitude = 0.012;
    found += any_drifts(record_of(vehicle, simulate_flight(vehicle, options).log));
  }
  EXPECT_LE(found, 1);
}

// How a sensor is mounted, its scale, bias or delay is none of it, nor is flight with little of anything.
TEST(SlowErrors, AreNotConfusedWithOtherSensorErrors) {
  const Vehicle plain = testing::published_vehicle();
  const auto with = [&](std::initializer_list<std::pair<const char*, double>> values) {
    Vehicle vehicle = plain;
    for (const auto& [name, value] : values) vehicle.parameters[name].value = value;
    return flown(vehicle, 1).log;
  };
  EXPECT_FALSE(
      any_drifts(record_of(plain, with({{"imu_misalignment.x", 0.05}, {"imu_misalignment.z", -0.04}}))));
  EXPECT_FALSE(any_drifts(record_of(plain, with({{"imu_bias.ax", 0.3}, {"imu_bias.az", -0.2}}))));
  EXPECT_FALSE(any_drifts(record_of(plain, with({{"imu_lever_arm.x", 0.06}, {"imu_lever_arm.z", 0.04}}))));
  EXPECT_FALSE(any_drifts(record_of(plain, with({{"sensor_delay.tau", 0.02}}))));
  EXPECT_FALSE(any_drifts(record_of(plain, with({{"wind.north", 4.0}, {"rotor_drag.kd", 1e-4}}))));
  FlightLog late = flown(plain, 1).log;
  for (auto& column : late.q_WB) std::shift_right(column.begin(), column.end(), 3);
  EXPECT_FALSE(drifts(record_of(plain, late)));
  FlightLog biased = flown(plain, 1).log;
  for (double& p : biased.w_B[0]) p += 0.03;
  EXPECT_FALSE(any_drifts(record_of(plain, biased)));
  FlightLog rare = flown(plain, 1).log;
  for (std::size_t i = 0; i < rare.rows(); ++i)
    for (auto& column : rare.q_WB)
      if (i % 10 != 0) column[i] = kNaN;
  EXPECT_FALSE(any_drifts(record_of(plain, rare)));
  FlightLog short_one = flown(plain, 1, 3.0).log;
  testing::drift_attitude(short_one, kError, 1);
  EXPECT_FALSE(any_drifts(record_of(plain, short_one)));  // too short to tell
}

// Noise rounds find the level, and the states the error itself.
TEST(SlowErrors, AreEstimatedWithTheFlight) {
  const Vehicle vehicle = testing::published_vehicle();
  FlightLog log = flown(vehicle, 3).log;
  const FlightLog true_log = log;
  testing::drift_attitude(log, kError, 3);
  const FlightRecord record = record_of(vehicle, log);
  ASSERT_TRUE(drifts(record));
  const Theta theta(parameter_vector(vehicle), {}, 1, true);
  const FlightFit fit = fit_flight(record, theta);
  double shown = 0, left = 0;
  for (std::size_t k = 0; k < fit.smoother->chunks().size(); ++k) {
    const FlightArc& arc = record.arcs[0];
    const std::size_t row = fit.smoother->chunks()[k].begin;
    const auto at = static_cast<std::size_t>(std::ranges::lower_bound(log.t, arc.t[row]) - log.t.begin());
    const auto attitude = [&](const FlightLog& of) {
      return Vec4<double>(of.q_WB[0][at], of.q_WB[1][at], of.q_WB[2][at], of.q_WB[3][at]);
    };
    const Vec3<double> error =
        rotation_vector_from_quaternion(quaternion_product(conjugate(attitude(true_log)), attitude(log)));
    shown += error.head<2>().squaredNorm();
    left += (error - fit.smoother->states()[k].shown_error[kShownAttitude]).head<2>().squaredNorm();
  }
  EXPECT_LT(left, 0.25 * shown);  // roll and pitch: gravity tells
  for (const ColouredNoise& axis : fit.noise.slow[kShownAttitude]) {
    const double density = axis.sigma * axis.sigma / axis.tau;
    EXPECT_NEAR(std::log(density / (kError.sigma * kError.sigma / kError.tau)), 0.0, 0.7);
  }
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(fit.noise.sigma[static_cast<std::size_t>(kAttitude + k)], noise_level("typical").attitude,
                0.2 * noise_level("typical").attitude);
}

// An error held at the most that the log allows has come to rest: rounds that go on are many times the fit.
TEST(SlowErrors, AtTheirUpperBoundEndTheNoiseRounds) {
  const Vehicle vehicle = testing::published_vehicle();
  FlightLog log = flown(vehicle, 3).log;
  testing::drift_attitude(log, kError, 3);
  FlightRecord record = record_of(vehicle, log);
  ASSERT_TRUE(drifts(record));
  for (ColouredNoise& axis : record.slow[kShownAttitude]) axis.sigma *= 0.03;
  const Theta theta(parameter_vector(vehicle), {}, 1, true);
  const FlightFit fit = fit_flight(record, theta);
  fit.smoother->linearize(fit.u, true);
  fit.smoother->accept();
  const std::array<ColouredNoise, 3> before = fit.noise.slow[kShownAttitude];
  const double change = fit.smoother->retune(1);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(fit.smoother->noise().slow[kShownAttitude][i].sigma / before[i].sigma, 1.0, 0.1);
  EXPECT_LT(change, 0.03);
}

TEST(SlowErrors, AreNoGapAndHideNone) {
  const Vehicle model = testing::published_vehicle();
  Vehicle truth = model;
  FlightLog log = flown(truth, 5).log;
  testing::drift_attitude(log, kError, 5);
  EXPECT_EQ(testing::verdict_of(model, log)["status"], "none");
  truth.parameters["imu_misalignment.y"].value = 0.03;
  FlightLog turned = flown(truth, 6).log;
  testing::drift_attitude(turned, kError, 6);
  const auto verdict = testing::verdict_of(model, turned);
  EXPECT_EQ(verdict["effects"], nlohmann::ordered_json({"imu_misalignment"})) << verdict;
}

TEST(SlowErrors, OfAnAutopilotsFilterAreNoGap) {
  const Vehicle model = testing::published_vehicle();
  FlightLog log = flown(model, 7).log;
  testing::estimate(log, model.g);
  EXPECT_EQ(testing::verdict_of(model, log)["status"], "none") << testing::verdict_of(model, log);
}

// By the rates that its attitude integrates, and without them by the forces that its velocities do.
TEST(SlowErrors, AnEstimatorIsDistinguishedFromSensors) {
  const Vehicle model = testing::published_vehicle();
  FlightLog log = flown(model, 8).log;
  FlightRecord sensors = record_of(model, log);
  EXPECT_FALSE(slow_errors(sensors).of_estimator);
  testing::estimate(log, model.g);
  FlightRecord filter = record_of(model, log);
  EXPECT_TRUE(slow_errors(filter).of_estimator);
  sensors.signals.rates = filter.signals.rates = false;
  EXPECT_FALSE(slow_errors(sensors).of_estimator);
  EXPECT_TRUE(slow_errors(filter).of_estimator);
}

}  // namespace
}  // namespace ident
