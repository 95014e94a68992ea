// Rotor speeds that are late are found and moved, and tell what else is late.
#include <gtest/gtest.h>

#include "support/late_streams.h"
#include "support/random_vehicle.h"

namespace ident {
namespace {

using namespace testing;  // flights of support/, not GoogleTest's

TEST(FlightStreams, RotorSpeedsThatAreLateAreReadEarlier) {
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    FlightLog log = simulated(vehicle, "mixed", seed);
    if (log.Omega.empty() || log.Omega[0].empty()) continue;
    const std::size_t rows = 1 + seed % 4;
    for (auto& column : log.Omega) delay(column, rows);
    const std::vector<FlightLog> logs{log};
    const double late = static_cast<double>(rows) / kRate;
    const StreamOffset found = stream_offsets(record_of(vehicle, logs), vehicle.g).speeds;
    EXPECT_NEAR(found.seconds, late, std::max(4 * found.std, 1e-3)) << seed;
    if (!(5 * found.std < found.seconds)) continue;
    ++told;
    std::vector<Warning> warnings;
    const std::vector<FlightLog> moved =
        aligned_streams(record_of(vehicle, logs), logs, vehicle.g, warnings).logs;
    ASSERT_FALSE(moved.empty()) << seed << ": " << found.seconds << " +- " << found.std;
    EXPECT_NE(warnings[0].message.find("rotor speeds show the same motion"), std::string::npos);
    EXPECT_LT(std::abs(stream_offsets(record_of(vehicle, moved), vehicle.g).speeds.seconds), 1e-3) << seed;
  }
  EXPECT_GE(told, 4);
}

// Thrust that climbs take back makes speeds look late to the force, and nothing of what turns the vehicle
// does.
TEST(FlightStreams, SpeedsThatAreLateAgainstForceOnlyAreNotShifted) {
  const Vehicle vehicle = random_vehicle(5);
  FlightLog log = simulated(vehicle, "mixed", 5);
  for (auto& column : log.Omega) delay(column, 4);
  EXPECT_FALSE(aligned(vehicle, log).logs.empty());
  for (auto& column : log.w_B) delay(column, 4);
  for (auto& column : log.q_WB) delay(column, 4);
  const std::vector<FlightLog> logs{log};
  const StreamOffsets found = stream_offsets(record_of(vehicle, logs), vehicle.g);
  EXPECT_NEAR(found.speeds.seconds, 4 / kRate, 1e-3);
  EXPECT_NEAR(found.moments.seconds, 0.0, 1e-3);
  const auto [moved, warnings] = aligned(vehicle, log);
  EXPECT_TRUE(moved.empty()) << warnings[0].message;
}

// 20 ms is more than a filter makes the rates late by: attitude and motion would be moved, if rotor speeds
// did not say that it is the IMU.
TEST(FlightStreams, RotorSpeedsDecideWhetherTheImuIsLate) {
  const Vehicle vehicle = random_vehicle(5);
  FlightLog log = late_by(4, vehicle, {&FlightLog::w_B, &FlightLog::f_B});
  for (const bool with_speeds : {true, false}) {
    if (!with_speeds) log.Omega.clear();
    const auto [moved, warnings] = aligned(vehicle, log);
    ASSERT_FALSE(moved.empty());
    EXPECT_EQ(moved[0].w_B[0][1000] != log.w_B[0][1000], with_speeds) << warnings[0].message;
    EXPECT_EQ(moved[0].x_W[0][1000] != log.x_W[0][1000], !with_speeds) << warnings[0].message;
  }
}

// What a satellite tells comes late; the force would be moved, if rotor speeds did not say that it is in
// time.
TEST(FlightStreams, RotorSpeedsDecideWhetherThePathIsLate) {
  const Vehicle vehicle = random_vehicle(5);
  FlightLog log = late_by(8, vehicle, {&FlightLog::v_W, &FlightLog::x_W});
  for (const bool with_speeds : {true, false}) {
    if (!with_speeds) log.Omega.clear();
    const auto [moved, warnings] = aligned(vehicle, log);
    ASSERT_FALSE(moved.empty());
    EXPECT_EQ(moved[0].f_B[2][1000] != log.f_B[2][1000], !with_speeds) << warnings[0].message;
    EXPECT_EQ(moved[0].v_W[2][1000] != log.v_W[2][1000], with_speeds) << warnings[0].message;
    EXPECT_EQ(moved[0].q_WB[1][1000], log.q_WB[1][1000]);
  }
}

// Held from one sample to the next they would look late by half of what is between.
TEST(FlightStreams, RareSpeedSamplesAreNotLate) {
  const Vehicle vehicle = random_vehicle(5);
  FlightLog log = simulated(vehicle, "mixed", 5);
  for (auto& column : log.Omega)
    for (std::size_t i = 0; i < column.size(); ++i)
      if (i % 4 != 0) column[i] = kNaN;
  const std::vector<FlightLog> logs{log};
  EXPECT_LT(std::abs(stream_offsets(record_of(vehicle, logs), vehicle.g).speeds.seconds), 1e-3);
  EXPECT_TRUE(aligned(vehicle, log).logs.empty());
}

// Motion capture is faster than that sensor, or nobody logged the commands.
TEST(FlightStreams, LateSpeedsAreFoundBesideASlowImuAndWithoutCommands) {
  const Vehicle vehicle = random_vehicle(5);
  FlightLog slow = simulated(vehicle, "mixed", 5);
  for (auto& column : slow.Omega) delay(column, 3);
  FlightLog without = slow;
  without.delta.clear();
  for (const auto sensor : {&FlightLog::w_B, &FlightLog::f_B})
    for (auto& column : slow.*sensor)
      for (std::size_t i = 1; i < column.size(); i += 2) column[i] = kNaN;
  for (const FlightLog* log : {&slow, &without}) {
    const std::vector<FlightLog> logs{*log};
    const StreamOffsets found = stream_offsets(record_of(vehicle, logs), vehicle.g);
    EXPECT_NEAR(found.moments.seconds, 3 / kRate, 1e-3);
    const auto [moved, warnings] = aligned(vehicle, *log);
    ASSERT_FALSE(moved.empty());
    EXPECT_NE(warnings[0].message.find("rotor speeds show"), std::string::npos) << warnings[0].message;
    EXPECT_NE(moved[0].Omega[0][1000], log->Omega[0][1000]);
  }
}

}  // namespace
}  // namespace ident
