// Recordings of real flights through the maps that the project ships. Skipped where they are not at hand.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"
#include "support/real_data.h"

namespace ident {
namespace {

const std::string kMaps = std::string(IDENT_SOURCE_DIR) + "/data/maps/";

Vehicle four_rotors() {
  Vehicle vehicle;
  vehicle.rotors = layout_rotors("x", 0.0396, 0.0);
  return vehicle;
}

double mean_in_windows(const FlightLog& log, const std::vector<double>& values) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < log.rows(); ++i)
    for (const auto& [from, to] : log.windows)
      if (log.t[i] >= from && log.t[i] <= to && !std::isnan(values[i])) sum += values[i], ++count;
  return sum / count;
}

Eigen::Quaterniond attitude(const FlightLog& log, std::size_t i) {
  return {log.q_WB[0][i], log.q_WB[1][i], log.q_WB[2][i], log.q_WB[3][i]};
}

Eigen::Vector3d at(const std::array<std::vector<double>, 3>& v, std::size_t i) {
  return {v[0][i], v[1][i], v[2][i]};
}

TEST(RealFlight, CrazyflieUnderAMapFliesWithGravityAlongMinusZ) {
  IDENT_NEEDS_REAL_DATA(folder);
  for (const char* n : {"10", "15", "16"}) {
    const FlightLog log = read_flight_log(folder + "/flight/arplab_crazyflie/log" + n + ".csv", four_rotors(),
                                          read_log_map(kMaps + "arplab_crazyflie_log" + n + ".yaml"));
    ASSERT_EQ(log.delta.size(), 4u);
    EXPECT_NEAR(mean_in_windows(log, log.f_B[2]), -9.81, 1.0) << n;
    for (const auto& delta : log.delta) {
      EXPECT_GE(*std::ranges::min_element(delta), 0.0);
      EXPECT_LE(*std::ranges::max_element(delta), 1.0);
      EXPECT_GT(mean_in_windows(log, delta), 0.4);
    }
    EXPECT_FALSE(log.has_attitude());
    EXPECT_TRUE(std::ranges::is_sorted(log.t));
  }
}

// The gyro has to turn the way the attitude does: sum over w . w_attitude is near that of w . w.
TEST(RealFlight, MotionCaptureAttitudeTurnsAsTheGyroSaysAndHoldsUpGravity) {
  IDENT_NEEDS_REAL_DATA(folder);
  for (const char* name : {"B3_figure8_fast_rep1", "B5_helix_fast_rep1", "B9_trefoil_medium_rep4"}) {
    const FlightLog log = read_flight_log(folder + "/flight/nanobench/" + name + ".csv", four_rotors(),
                                          read_log_map(kMaps + "nanobench_crazyflie.yaml"));
    double along = 0.0, own = 0.0;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    int forces = 0;
    for (std::size_t i = 10; i + 10 < log.rows(); ++i) {
      const Eigen::AngleAxisd turn(attitude(log, i - 10).conjugate() * attitude(log, i + 10));
      const Eigen::Vector3d w = turn.angle() * turn.axis() / (log.t[i + 10] - log.t[i - 10]);
      if (at(log.w_B, i).allFinite() && w.allFinite() && turn.angle() < 1.0)
        along += w.dot(at(log.w_B, i)), own += w.squaredNorm();
      if (log.x_W[2][i] > -0.3 || !at(log.f_B, i).allFinite()) continue;
      force += attitude(log, i) * at(log.f_B, i);
      ++forces;
    }
    EXPECT_NEAR(along / own, 1.0, 0.25) << name;
    force /= forces;
    EXPECT_NEAR(force.z(), -9.81, 0.4) << name;
    EXPECT_LT(force.head<2>().norm(), 0.6) << name;
  }
}

TEST(RealFlight, LogWithoutRatesAndAttitudeKeepsWhatItHas) {
  IDENT_NEEDS_REAL_DATA(folder);
  const FlightLog log = read_flight_log(folder + "/flight/crazypad/m_normal_flight__E8_log00.csv",
                                        four_rotors(), read_log_map(kMaps + "crazypad_crazyflie.yaml"));
  EXPECT_TRUE(log.has_velocity());
  EXPECT_TRUE(log.has_position());
  EXPECT_FALSE(log.has_rates());
  EXPECT_FALSE(log.has_attitude());
  EXPECT_LT(*std::ranges::min_element(log.x_W[2]), -0.3);  // it took off, and z points down here
  EXPECT_NEAR(log.vbat.front(), 3.811, 1e-9);
}

TEST(RealFlight, LogWithoutMotorCommandsIsRefusedByName) {
  IDENT_NEEDS_REAL_DATA(folder);
  const std::string path = folder + "/flight/crazyswarm2_slung/log178.csv";
  LogMap map;
  map.columns = {{"t", {.column = "t_s"}}, {"p", {.column = "ctrlLee.omegax"}}};
  try {
    read_flight_log(path, four_rotors(), map);
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("commands or rotor speeds"), std::string::npos) << error.what();
  }
}

TEST(RealFlight, LogOfAnAutopilotIsReadAsItIs) {
  IDENT_NEEDS_REAL_DATA(folder);
  const FlightLog log =
      read_flight_log(folder + "/logs/ulog/pyulog__sample_px4_events.ulg", four_rotors(), {});
  EXPECT_EQ(log.delta.size(), 4U);
  ASSERT_EQ(log.windows.size(), 1U);
  // At hover the accelerometer shows gravity upward; in FRD that is along -z.
  EXPECT_NEAR(mean_in_windows(log, log.f_B[2]), -9.81, 0.2);
}

TEST(RealFlight, CardFileOfACrazyflieIsTheCsvThatWasMadeOfIt) {
  IDENT_NEEDS_REAL_DATA(folder);
  const FlightLog card = read_flight_log(folder + "/logs/crazyflie/arplab__log16.usd", four_rotors(), {});
  const FlightLog csv = read_flight_log(folder + "/flight/arplab_crazyflie/log16.csv", four_rotors(),
                                        read_log_map(kMaps + "arplab_crazyflie_log16.yaml"));
  // Their clocks start at different times: compared sample by sample from the first motor command on.
  const auto start = [](const FlightLog& log) {
    std::size_t i = 0;
    while (log.delta[0][i] == 0) ++i;
    return i;
  };
  const std::size_t a = start(card), b = start(csv);
  for (std::size_t i = 0; i < 5000; ++i)
    for (std::size_t k = 0; k < 4; ++k) ASSERT_NEAR(card.delta[k][a + i], csv.delta[k][b + i], 1e-6) << i;
}

}  // namespace
}  // namespace ident
