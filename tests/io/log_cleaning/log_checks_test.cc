// Sensors that stand still, and commands that are none.
#include "ident/io/log_cleaning/log_checks.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "ident/core/error.h"
#include "ident/core/random.h"
#include "ident/flight/make_record.h"
#include "ident/flight/record/flight_record.h"
#include "ident/io/log_cleaning/log_checks_motion.h"
#include "ident/io/log_cleaning/log_checks_rotors.h"
#include "support/published_hover.h"

namespace ident {
namespace {

FlightLog hover(std::uint64_t seed = 1) {
  SimulationOptions options;
  options.scenario = "hover", options.duration = 10.0, options.rate = 100.0, options.seed = seed;
  return simulate_flight(testing::published_vehicle(), options).log;
}

std::size_t missing(const std::vector<double>& column) {
  return static_cast<std::size_t>(std::ranges::count_if(column, [](double v) { return std::isnan(v); }));
}

void freeze(std::span<std::vector<double>> sensor, std::size_t from, std::size_t to) {
  for (std::vector<double>& c : sensor)
    for (std::size_t i = from; i < to; ++i) c[i] = c[from];
}

TEST(LogChecks, ASensorThatFreezesCountsAsNotSampledThere) {
  FlightLog log = hover();
  freeze(log.w_B, 300, 500);
  drop_frozen(log, log.w_B, "p q r");
  EXPECT_EQ(missing(log.w_B[0]), 199u) << "all but the first";
  ASSERT_EQ(log.warnings.size(), 1u);
  EXPECT_EQ(log.warnings[0].code, "frozen_signal");
  EXPECT_NE(log.warnings[0].message.find("1.99 s from t = 3"), std::string::npos) << log.warnings[0].message;
}

TEST(LogChecks, ASensorThatStandsStillWithAllOthersIsNotFrozen) {
  FlightLog log = hover();
  for (auto* sensor : {&log.w_B, &log.f_B, &log.x_W, &log.v_W}) freeze(*sensor, 300, 500);
  freeze(log.q_WB, 300, 500);
  drop_frozen(log, log.w_B, "p q r");
  EXPECT_EQ(missing(log.w_B[0]), 0u);
  EXPECT_TRUE(log.warnings.empty());
}

TEST(LogChecks, AMomentIsNotFrozenAndCoarseStepsAreNot) {
  FlightLog log = hover();
  freeze(log.w_B, 300, 319);
  drop_frozen(log, log.w_B, "p q r");
  for (std::vector<double>& c : log.w_B)
    for (double& v : c) v = std::round(v / 0.2) * 0.2;
  freeze(log.w_B, 600, 800);
  drop_frozen(log, log.w_B, "p q r");
  EXPECT_EQ(missing(log.w_B[0]), 0u);
}

TEST(LogChecks, ACommandThatNeverChangesBesideASpeedThatDoesIsNamed) {
  FlightLog log = hover();
  FlightLog still = log;
  check_commands(log);
  EXPECT_TRUE(log.has_commands());
  std::ranges::fill(still.delta[2], 0.5);
  check_commands(still);
  ASSERT_EQ(still.warnings.size(), 1u);
  EXPECT_EQ(still.warnings[0].code, "constant_command");
  EXPECT_NE(still.warnings[0].message.find("rotor 3"), std::string::npos) << still.warnings[0].message;
  EXPECT_FALSE(still.has_commands()) << "the speeds serve as input";
}

TEST(LogChecks, OneComponentThatNeverChangesIsNotMeasured) {
  FlightLog log = hover();
  std::ranges::fill(log.w_B[0], 0.1);
  drop_constant(log, log.w_B, "p q r");
  EXPECT_EQ(missing(log.w_B[0]), log.rows());
  EXPECT_EQ(missing(log.w_B[1]), 0u);
  ASSERT_EQ(log.warnings.size(), 1u);
  EXPECT_EQ(log.warnings[0].code, "constant_signal");
}

// By differences alone a sensor that counts in steps has no noise, and then weighs more than all others.
TEST(LogChecks, ASensorThatCountsInStepsHasTheNoiseOfItsSteps) {
  const Vehicle vehicle = testing::published_vehicle();
  FlightLog log = hover();
  const auto sigma = [&](int channel) {
    return make_flight_record(vehicle, parameter_vector(vehicle), {&log, 1})
        .sigma[static_cast<std::size_t>(channel)];
  };
  const double fine = sigma(kGyro), place = sigma(kPosition);
  for (std::vector<double>& c : log.w_B)
    for (double& v : c) v = std::round(v / 0.2) * 0.2;
  EXPECT_GT(sigma(kGyro), 0.9 * 0.2 / std::sqrt(12.0));
  EXPECT_LT(sigma(kGyro), 0.2);
  EXPECT_LT(fine, 0.2 / std::sqrt(12.0));
  EXPECT_EQ(sigma(kPosition), place);
}

// Attitude as it would be read if angles in degrees were taken for radians.
void take_degrees_for_radians(FlightLog& log) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    Eigen::Quaterniond q(log.q_WB[0][i], log.q_WB[1][i], log.q_WB[2][i], log.q_WB[3][i]);
    const Eigen::Vector3d angles = kDegrees * q.normalized().toRotationMatrix().eulerAngles(2, 1, 0);
    q = Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
        Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitX());
    log.q_WB[0][i] = q.w(), log.q_WB[1][i] = q.x(), log.q_WB[2][i] = q.y(), log.q_WB[3][i] = q.z();
  }
}

TEST(LogChecks, AnglesInDegreesAreToldFromAVehicleThatHardlyTurns) {
  for (const char* scenario : {"hover", "eight", "mixed"}) {
    SimulationOptions options;
    options.scenario = scenario, options.duration = 20.0, options.rate = 100.0;
    FlightLog log = simulate_flight(testing::published_vehicle(), options).log;
    EXPECT_NO_THROW(check_rates_against_attitude(log, 1, false)) << scenario;
    take_degrees_for_radians(log);
    EXPECT_THROW(check_rates_against_attitude(log, 1, false), InputError) << scenario;
  }
}

// Noise of the attitude alone makes it turn some sixty times faster than this vehicle does.
TEST(LogChecks, ANoisyAttitudeOfAVehicleThatHardlyTurnsIsNotInDegrees) {
  FlightLog log = hover();
  Random random(1);
  for (std::size_t i = 0; i < log.rows(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      log.w_B[k][i] = 3e-3 * random.normal();
      log.q_WB[k + 1][i] = 2e-3 * random.normal();
    }
    log.q_WB[0][i] = 1.0;
  }
  EXPECT_NO_THROW(check_rates_against_attitude(log, 1, false));
}

FlightLog flown(const char* scenario) {
  SimulationOptions options;
  options.scenario = scenario, options.duration = 20.0, options.rate = 100.0, options.seed = 3;
  return simulate_flight(testing::published_vehicle(), options).log;
}

TEST(LogChecks, VelocitiesAlongTheBodyAreNamedAndThoseOfTheWorldAreNot) {
  const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d flu = Eigen::Vector3d(1, -1, -1).asDiagonal();
  for (const char* scenario : {"hover", "mixed", "eight"})
    EXPECT_NO_THROW(check_velocity_axes(flown(scenario), 1, same));
  FlightLog log = flown("mixed");
  for (std::size_t i = 0; i < log.rows(); ++i) {
    const Eigen::Quaterniond q(log.q_WB[0][i], log.q_WB[1][i], log.q_WB[2][i], log.q_WB[3][i]);
    const Eigen::Vector3d v_B = q.conjugate() * Eigen::Vector3d(log.v_W[0][i], log.v_W[1][i], log.v_W[2][i]);
    for (std::size_t k = 0; k < 3; ++k) log.v_W[k][i] = v_B[static_cast<Eigen::Index>(k)];
  }
  EXPECT_THROW(check_velocity_axes(log, 1, same), InputError);
  for (const std::size_t k : {1, 2})
    for (double& v : log.v_W[k]) v = -v;
  EXPECT_NO_THROW(check_velocity_axes(log, 1, same));
  EXPECT_THROW(check_velocity_axes(log, 1, flu), InputError);
}

TEST(LogChecks, AnAccelerationWithoutGravityIsNamedHoweverHardItIsFlown) {
  FlightLog log = flown("mixed");
  check_specific_force(log, 1, 9.81);
  EXPECT_TRUE(log.warnings.empty());
  for (double& f : log.f_B[0]) f += 4.0;
  for (double& f : log.f_B[2]) f += 9.81;
  check_specific_force(log, 1, 9.81);
  ASSERT_EQ(log.warnings.size(), 1u);
  EXPECT_EQ(log.warnings[0].code, "gravity_missing");
}

TEST(LogChecks, OfQuaternionsTheRatesHaveTheWrongUnit) {
  FlightLog log = flown("mixed");
  for (auto& column : log.w_B)
    for (double& w : column) w *= std::numbers::pi / 180;
  for (const bool quaternions : {true, false}) try {
      check_rates_against_attitude(log, 1, quaternions);
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("p, q, r") != std::string::npos, quaternions) << error.what();
    }
}

std::string refused(const std::function<void()>& check) {
  try {
    check();
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(LogChecks, AUnitOfTimeThatMakesRowsComeAsInNoLogIsRefused) {
  const auto spread = [](double factor, bool stated) {
    FlightLog log = hover();
    for (double& t : log.t) t *= factor;
    return refused([&] { check_time(log, 7, stated); });
  };
  EXPECT_EQ(spread(1, true), "");
  EXPECT_EQ(spread(0.1, true), "");
  EXPECT_NE(spread(1000, true).find("rows come 10 s apart by the unit that was stated"), std::string::npos)
      << spread(1000, true);
  EXPECT_NE(spread(1e-3, false).find(":7: t: rows come 1e-05 s apart"), std::string::npos)
      << spread(1e-3, false);
}

TEST(LogChecks, AVoltageInAnotherUnitIsRefused) {
  FlightLog log = hover();
  for (const auto& [volts, right] : {std::pair(15.1, true), {9.0, true}, {1.51, false}, {15100, false}}) {
    log.vbat.assign(log.rows(), volts);
    EXPECT_EQ(refused([&] { check_voltage(log, 7, 16.0); }).empty(), right) << volts;
  }
  log.vbat.clear();
  EXPECT_EQ(refused([&] { check_voltage(log, 7, 16.0); }), "");
}

}  // namespace
}  // namespace ident
