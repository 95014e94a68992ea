// Streams of one log at different times are found, moved to one time, and nothing is moved that is not late.
#include "ident/flight/conditioning/align_streams.h"

#include <gtest/gtest.h>

#include "ident/core/random.h"
#include "ident/flight/prepare.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"
#include "ident/sim/simulate.h"
#include "support/late_streams.h"
#include "support/random_vehicle.h"
#include "support/real_data.h"

namespace ident {
namespace {

using namespace testing;  // flights of support/, not GoogleTest's

TEST(FlightStreams, StreamsAtOneTimeAreLeftAlone) {
  const std::array scenarios = {"mixed", "hover", "steps", "eight", "vertical", "yaw"};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Vehicle vehicle = random_vehicle(seed);
    if (seed % 3 == 1)  // turns about this arm are in the specific force
      vehicle.parameters["imu_lever_arm.x"].value = 0.02, vehicle.parameters["imu_lever_arm.z"].value = -0.03;
    if (seed % 3 == 2) vehicle.parameters["sensor_delay.tau"].value = 0.012;  // rates and attitude alike
    const std::vector<FlightLog> logs{simulated(vehicle, scenarios[seed % scenarios.size()], seed)};
    std::vector<Warning> warnings;
    EXPECT_TRUE(aligned_streams(record_of(vehicle, logs), logs, vehicle.g, warnings).logs.empty())
        << seed << ": " << (warnings.empty() ? "" : warnings[0].message);
  }
}

// On a circle turns about one axis follow those about the other: seen by a sensor askew they look late.
TEST(FlightStreams, ASensorAskewIsNotLate) {
  const Vehicle vehicle = random_vehicle(3);
  FlightLog log = simulated(vehicle, "hover", 3);
  Random random(5);
  Vec4<double> q(1, 0, 0, 0);
  constexpr double askew = 0.15;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    const double phase = 4.4 * log.t[i];
    const Eigen::Vector3d w(0.8 * std::sin(phase), 0.8 * std::cos(phase), 0.2 * std::sin(0.3 * phase));
    const double seen[3] = {w[0] * std::cos(askew) + w[1] * std::sin(askew),
                            w[1] * std::cos(askew) - w[0] * std::sin(askew), w[2]};
    for (std::size_t k = 0; k < 3; ++k) log.w_B[k][i] = seen[k] + 0.01 * random.normal();
    for (std::size_t k = 0; k < 4; ++k) log.q_WB[k][i] = q[static_cast<Eigen::Index>(k)];
    q = quaternion_product(q, quaternion_from_rotation_vector(Vec3<double>(w / kRate))).normalized();
  }
  const std::vector<FlightLog> logs{log};
  const StreamOffset late = stream_offsets(record_of(vehicle, logs), vehicle.g).rates;
  ASSERT_TRUE(std::isfinite(late.std));
  EXPECT_LT(std::abs(late.seconds), 4e-3) << "+- " << late.std;
}

TEST(FlightStreams, ALateStreamIsFoundAndMoved) {
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    FlightLog log = simulated(vehicle, "mixed", seed);
    const std::size_t rows = 3 + seed % 5;
    const bool force = seed % 2 == 0;
    if (force)
      for (auto& column : log.f_B) delay(column, rows);
    else {
      for (auto& column : log.q_WB) delay(column, rows);
      for (auto& column : log.v_W) delay(column, rows);
      for (auto& column : log.x_W) delay(column, rows);
    }
    const std::vector<FlightLog> logs{log};
    const FlightRecord record = record_of(vehicle, logs);
    const StreamOffsets found = stream_offsets(record, vehicle.g);
    const StreamOffset& late = force ? found.force : found.rates;
    const double truth = (force ? 1.0 : -1.0) * static_cast<double>(rows) / kRate;
    if (!std::isfinite(late.std)) continue;
    ++told;
    EXPECT_NEAR(late.seconds, truth, 3e-3) << seed << " +- " << late.std;
    std::vector<Warning> warnings;
    const std::vector<FlightLog> aligned = aligned_streams(record, logs, vehicle.g, warnings).logs;
    ASSERT_EQ(aligned.size(), 1) << seed;
    ASSERT_EQ(warnings.size(), 1) << seed;
    EXPECT_EQ(warnings[0].code, "stream_offset");
    const StreamOffsets after = stream_offsets(record_of(vehicle, aligned), vehicle.g);
    EXPECT_LT(std::abs((force ? after.force : after.rates).seconds), 1e-3) << seed;
  }
  EXPECT_GE(told, 10);
}

// An autopilot filters what it logs of its IMU.
TEST(FlightStreams, FilteredRatesAreReadEarlierAndTheForceWithThem) {
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    FlightLog log = simulated(vehicle, "mixed", seed);
    const double late = 2e-3 + 5e-4 * static_cast<double>(seed % 5);
    for (auto* sensor : {&log.w_B, &log.f_B})
      for (auto& column : *sensor) {
        double shown = column[0];
        for (double& value : column) value = shown += (1 - std::exp(-1 / (kRate * late))) * (value - shown);
      }
    // Held from row to row, a first-order lag is late by half a row less.
    const double lag = 1 / (kRate * (1 - std::exp(-1 / (kRate * late)))) - 1 / kRate;
    const std::vector<FlightLog> logs{log};
    const FlightRecord record = record_of(vehicle, logs);
    const StreamOffset rates = stream_offsets(record, vehicle.g).rates;
    if (!std::isfinite(rates.std) || 5 * rates.std > lag || lag < 1.2e-3) continue;
    ++told;
    EXPECT_NEAR(rates.seconds, lag, 4e-4 + 3 * rates.std) << seed << " +- " << rates.std;
    std::vector<Warning> warnings;
    const std::vector<FlightLog> aligned = aligned_streams(record, logs, vehicle.g, warnings).logs;
    ASSERT_EQ(aligned.size(), 1) << seed;
    ASSERT_EQ(warnings.size(), 1) << seed;
    EXPECT_NE(warnings[0].message.find("with the specific force"), std::string::npos) << warnings[0].message;
    EXPECT_EQ(aligned[0].q_WB[1][100], log.q_WB[1][100]);
    EXPECT_NE(aligned[0].f_B[2][100], log.f_B[2][100]);
    EXPECT_LT(std::abs(stream_offsets(record_of(vehicle, aligned), vehicle.g).rates.seconds), 6e-4) << seed;
  }
  EXPECT_GE(told, 4);
}

TEST(FlightStreams, APathIsLateInALogWithoutAttitude) {
  const Vehicle vehicle = random_vehicle(5);
  FlightLog log = late_by(8, vehicle, {&FlightLog::v_W, &FlightLog::x_W});
  for (auto& column : log.q_WB) column.clear();
  const auto [moved, warnings] = aligned(vehicle, log);
  ASSERT_FALSE(moved.empty());
  EXPECT_NE(warnings[0].message.find("the velocity and position show"), std::string::npos)
      << warnings[0].message;
  EXPECT_FALSE(moved[0].has_attitude());
}

// No accelerometer is early by a tenth of a second, whether or not anything else says so. Satellites are
// seldom heard.
TEST(FlightStreams, AVeryLatePathIsShiftedInsteadOfTheForce) {
  const Vehicle vehicle = random_vehicle(5);
  const FlightLog whole = late_by(25, vehicle, {&FlightLog::v_W, &FlightLog::x_W});
  for (const std::size_t every : {1, 20})
    for (const bool with_speeds : {true, false}) {
      FlightLog log = whole;
      for (const auto stream : {&FlightLog::v_W, &FlightLog::x_W})
        for (auto& column : log.*stream)
          for (std::size_t i = 0; i < column.size(); ++i)
            if (i % every != 0) column[i] = kNaN;
      if (!with_speeds) log.Omega.clear();
      const std::vector<FlightLog> logs{log};
      EXPECT_NEAR(stream_offsets(record_of(vehicle, logs), vehicle.g).force.seconds, -25 / kRate, 4e-3);
      const auto [moved, warnings] = aligned(vehicle, log);
      ASSERT_FALSE(moved.empty()) << every;
      EXPECT_EQ(moved[0].f_B[2][1000], log.f_B[2][1000]) << warnings[0].message;
      EXPECT_NE(moved[0].v_W[2][1000], log.v_W[2][1000]) << warnings[0].message;
      EXPECT_EQ(moved[0].q_WB[1][1000], log.q_WB[1][1000]);
    }
}

// Force and speeds are in time with each other once the IMU was moved: what is left is the path's.
TEST(FlightStreams, ImuAndPathMayBeLateBoth) {
  const Vehicle vehicle = random_vehicle(5);
  const auto [moved, warnings] = aligned(
      vehicle, late_by(4, vehicle, {&FlightLog::w_B, &FlightLog::f_B, &FlightLog::v_W, &FlightLog::x_W}));
  ASSERT_FALSE(moved.empty());
  const StreamOffsets left = stream_offsets(record_of(vehicle, moved), vehicle.g);
  for (const StreamOffset& one : {left.rates, left.force, left.speeds})
    EXPECT_LT(std::abs(one.seconds), 2e-3) << warnings[0].message;
}

TEST(FlightStreams, ARealAccelerometerIsLaterThanMotionCapture) {
  IDENT_NEEDS_REAL_DATA(folder);
  Vehicle vehicle;
  vehicle.rotors = layout_rotors("x", 0.046, 0.0);
  vehicle.parameters["m"].value = 0.035;
  std::vector<FlightLog> logs;
  for (const char* name : {"B3_figure8_fast_rep1", "B6_linear_ramp_rep3", "B9_trefoil_medium_rep4"})
    logs.push_back(
        read_flight_log(folder + "/flight/nanobench/" + name + ".csv", vehicle,
                        read_log_map(std::string(IDENT_SOURCE_DIR) + "/data/maps/nanobench_crazyflie.yaml")));
  const StreamOffsets found = stream_offsets(record_of(vehicle, logs), vehicle.g);
  EXPECT_NEAR(found.force.seconds, 0.023, 0.01) << "+- " << found.force.std;
  EXPECT_NEAR(found.rates.seconds, 0.0, 0.008) << "+- " << found.rates.std;
}

}  // namespace
}  // namespace ident
