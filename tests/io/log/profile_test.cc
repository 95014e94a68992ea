// Streams of a log become a flight log by a profile, line by line under a user's map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "ident/core/error.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/profile_texts.h"
#include "ident/io/log/profiles.h"
#include "ident/io/log/read_flight_log.h"
#include "ident/io/log_formats/read_log_streams.h"

namespace ident {
namespace {

std::vector<double> times(double from, double step, int count) {
  std::vector<double> t;
  for (int i = 0; i < count; ++i) t.push_back(from + step * i);
  return t;
}

std::vector<double> wave(const std::vector<double>& t, double mean, double size, double phase) {
  std::vector<double> values;
  for (const double s : t) values.push_back(mean + size * std::sin(7 * s + phase));
  return values;
}

/// A quadrotor's DataFlash log of 10 s: gyro at 50 Hz, outputs at 10 Hz, in the air from 2 to 8 s. Motor 1 is
/// on output 3.
LogStreams dataflash() {
  LogStreams log{.file = "flight.bin", .format = "dataflash"};
  const std::vector<double> fast = times(0.0, 0.02, 500), slow = times(0.005, 0.1, 100);
  LogStream imu{.name = "IMU", .clock = "", .t = fast, .fields = {}};
  imu.fields = {{"I", "", 1.0, std::vector<std::uint8_t>(500, 0)}, {"GyrX", "", 1.0, wave(fast, 0, 0.5, 0)},
                {"GyrY", "", 1.0, wave(fast, 0, 0.4, 1)},          {"GyrZ", "", 1.0, wave(fast, 0, 0.3, 2)},
                {"AccX", "", 1.0, wave(fast, 0, 0.3, 3)},          {"AccY", "", 1.0, wave(fast, 0, 0.3, 4)},
                {"AccZ", "", 1.0, wave(fast, -9.8, 0.5, 5)}};
  LogStream out{.name = "RCOU", .clock = "", .t = slow, .fields = {}};
  for (int n = 1; n <= 4; ++n)
    out.fields.push_back({"C" + std::to_string(n), "", 1.0, wave(slow, 1500, 100, n)});
  LogStream events{.name = "EV", .clock = "", .t = {2.0, 8.0}, .fields = {}};
  events.fields = {{"Id", "", 1.0, std::vector<std::uint8_t>{28, 18}}};
  log.streams = {imu, out, events};
  log.parameters = {{"SERVO1_FUNCTION", 34}, {"SERVO2_FUNCTION", 35}, {"SERVO3_FUNCTION", 33},
                    {"SERVO4_FUNCTION", 36}, {"MOT_PWM_MIN", 1000},   {"MOT_PWM_MAX", 2000}};
  return log;
}

std::size_t row_at(const FlightLog& log, double t) {
  std::size_t i = 0;
  while (log.t[i] < t - 1e-9) ++i;
  return i;
}

TEST(Profiles, EachIsAMapThatReads) {
  ASSERT_GE(profile_texts().size(), 3U);
  for (const ProfileText& profile : profile_texts()) {
    const LogMap map = parse_log_map(std::string(profile.text), std::string(profile.name));
    EXPECT_FALSE(map.formats.empty()) << profile.name;
    EXPECT_FALSE(map.columns.empty()) << profile.name;
  }
}

TEST(Profiles, MotorsAreFoundByTheFunctionsOfOutputs) {
  const LogStreams streams = dataflash();
  const FlightLog log = flight_log_of(streams, Vehicle{}, {});
  ASSERT_EQ(log.delta.size(), 4U);
  const double pulse = streams.find("RCOU")->find("C3")->at(40);  // output 3 is motor 1
  EXPECT_NEAR(log.delta[0][row_at(log, 4.005)], (pulse - 1000) / 1000, 1e-12);
}

TEST(Profiles, EachSignalKeepsItsOwnTimes) {
  const FlightLog log = flight_log_of(dataflash(), Vehicle{}, {});
  EXPECT_EQ(log.rows(), 600U);  // 500 and 100 instants, none in common
  EXPECT_TRUE(std::isnan(log.w_B[0][row_at(log, 4.005)]));
  EXPECT_NEAR(log.w_B[0][row_at(log, 4.0)], 0.5 * std::sin(7 * 4.0), 1e-12);
}

TEST(Profiles, OnlyTheTimeInTheAirIsUsed) {
  const FlightLog log = flight_log_of(dataflash(), Vehicle{}, {});
  ASSERT_EQ(log.windows.size(), 1U);
  EXPECT_DOUBLE_EQ(log.windows[0][0], 2.0);
  EXPECT_DOUBLE_EQ(log.windows[0][1], 8.0);
  // Sensors say nothing of flight on the ground and where it may push; commands from before still act.
  for (const double t : {1.0, 2.5, 7.0, 9.0}) EXPECT_TRUE(std::isnan(log.w_B[0][row_at(log, t)])) << t;
  EXPECT_TRUE(std::isfinite(log.w_B[0][row_at(log, 4.0)]));
  EXPECT_TRUE(std::isfinite(log.delta[0][row_at(log, 1.005)]));
}

TEST(Profiles, AWindowThatWasChosenIsUsedToItsEnds) {
  const LogMap user = parse_log_map("windows: [[1, 9]]\n", "mine.yaml");
  const FlightLog log = flight_log_of(dataflash(), Vehicle{}, user);
  for (const double t : {1.0, 2.5, 7.0, 9.0}) EXPECT_TRUE(std::isfinite(log.w_B[0][row_at(log, t)])) << t;
  EXPECT_TRUE(std::isnan(log.w_B[0][row_at(log, 0.9)]));
}

TEST(Profiles, ASpeedControllerReportsUnderTheNumberOfItsOutput) {
  LogStreams streams = dataflash();
  LogStream esc{.name = "ESC", .clock = "", .t = {}, .fields = {}};
  std::vector<std::uint8_t> instance;
  std::vector<double> rpm;
  for (int i = 0; i < 400; ++i) {
    esc.t.push_back(0.003 + 0.02 * i);
    instance.push_back(static_cast<std::uint8_t>(i % 4));
    rpm.push_back(1000.0 * (1 + i % 4) + i);
  }
  esc.fields = {{"Instance", "", 1.0, instance}, {"RPM", "rpm", 1.0, rpm}};
  streams.streams.push_back(esc);
  const FlightLog log = flight_log_of(streams, Vehicle{}, {});
  ASSERT_EQ(log.Omega.size(), 4U);
  // Motor 1 hangs on output 3, whose instance is 2.
  EXPECT_NEAR(log.Omega[0][row_at(log, 0.003 + 0.02 * 202)], (3000 + 202) * M_PI / 30, 1e-9);
}

TEST(Profiles, ALowPassThatTheLogStatesIsTakenBack) {
  LogStreams streams = dataflash();
  streams.parameters["INS_GYRO_FILTER"] = 5;
  const FlightLog log = flight_log_of(streams, Vehicle{}, {});
  const double w = 2 * M_PI * 5, t = 4.0, f = 7.0;
  const double filtered = 0.5 * std::sin(f * t), rate = 0.5 * f * std::cos(f * t);
  EXPECT_NEAR(log.w_B[0][row_at(log, t)], filtered + M_SQRT2 / w * rate - f * f * filtered / (w * w), 2e-3);
  EXPECT_TRUE(std::ranges::any_of(log.notices, [](const std::string& notice) {
    return notice.find("low-pass on the vehicle, 45 ms late") != std::string::npos;
  }));
}

TEST(Profiles, ALowPassThatAMapNamesAndTheLogDoesNotStateIsToldSo) {
  const LogMap user =
      parse_log_map("columns: {p: {stream: IMU, column: GyrX, behind: INS_GYRO_FILTR}}\n", "mine.yaml");
  try {
    flight_log_of(dataflash(), Vehicle{}, user);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'INS_GYRO_FILTR' is neither"), std::string::npos)
        << error.what();
  }
}

TEST(Profiles, ALogSaysWhetherItHasEachCommandOfTheLoop) {
  LogStreams streams = dataflash();
  EXPECT_EQ(flight_log_of(streams, Vehicle{}, {}).loop, 0.0);
  streams.parameters["SCHED_LOOP_RATE"] = 400;
  std::erase_if(streams.streams, [](const LogStream& s) { return s.name == "RCOU"; });
  LogStream made{.name = "motor_commands", .clock = "", .t = times(0, 0.0025, 4000), .fields = {}};
  for (int n = 0; n < 4; ++n)
    made.fields.push_back({"motor[" + std::to_string(n) + "]", "", 1.0, wave(made.t, 0.5, 0.1, n)});
  streams.streams.push_back(made);
  EXPECT_DOUBLE_EQ(flight_log_of(streams, Vehicle{}, {}).loop, 0.0025);
  EXPECT_TRUE(flight_log_of(streams, Vehicle{}, {}).each_command);
  streams.parameters["SCHED_LOOP_RATE"] = 800;
  EXPECT_DOUBLE_EQ(flight_log_of(streams, Vehicle{}, {}).loop, 0.00125);
  EXPECT_FALSE(flight_log_of(streams, Vehicle{}, {}).each_command);
}

TEST(Profiles, AMapOverridesSingleLines) {
  const LogMap user = parse_log_map(
      "columns: {p: {stream: IMU, column: GyrY, unit: deg/s}, q: null}\nwindows: [[3, 5]]\n", "mine.yaml");
  const FlightLog log = flight_log_of(dataflash(), Vehicle{}, user);
  EXPECT_NEAR(log.w_B[0][row_at(log, 4.0)], 0.4 * std::sin(7 * 4.0 + 1) * M_PI / 180, 1e-12);
  EXPECT_TRUE(std::isnan(log.w_B[1][row_at(log, 4.0)]));
  EXPECT_NEAR(log.w_B[2][row_at(log, 4.0)], 0.3 * std::sin(7 * 4.0 + 2), 1e-12);
  EXPECT_DOUBLE_EQ(log.windows[0][0], 3.0);
}

TEST(Profiles, AMapThatNamesWhatIsNotThereIsToldSo) {
  const LogMap user = parse_log_map("columns: {p: {stream: IMU, column: GyroX}}\n", "mine.yaml");
  try {
    flight_log_of(dataflash(), Vehicle{}, user);
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("mine.yaml:1"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("GyrX"), std::string::npos) << error.what();
  }
}

TEST(Profiles, ACsvOfTheCrazyfliesClientNeedsNoMap) {
  const std::string path = ::testing::TempDir() + "/client.csv";
  std::ofstream file(path);
  file << "Timestamp,gyro.x,gyro.y,gyro.z,motor.m1,motor.m2,motor.m3,motor.m4\n";
  for (int i = 0; i < 200; ++i)
    file << 1000 + 10 * i << ',' << 57 * std::sin(0.3 * i) << ',' << 40 * std::sin(0.2 * i) << ','
         << 30 * std::cos(0.1 * i) << ',' << 30000 + 1000 * (i % 7) << ',' << 30000 + 900 * (i % 5) << ','
         << 30000 + 800 * (i % 3) << ',' << 65535 - 700 * (i % 4) << '\n';
  file.close();
  const FlightLog log = read_flight_log(path, Vehicle{}, {});
  ASSERT_EQ(log.delta.size(), 4U);
  EXPECT_NEAR(log.delta[3][4], 1.0, 1e-9);                             // 65535
  EXPECT_NEAR(log.t[10] - log.t[0], 0.1, 1e-9);                        // ms
  EXPECT_NEAR(log.w_B[1][5], -40 * std::sin(1.0) * M_PI / 180, 1e-6);  // deg/s, y to the left
}

TEST(Profiles, ALogThatNeverFliesIsRefused) {
  LogStreams log = dataflash();
  log.streams[2].fields[0].values = std::vector<std::uint8_t>{18, 18};
  EXPECT_THROW(flight_log_of(log, Vehicle{}, {}), DataError);
}

TEST(Profiles, MoreMotorsThanTheVehicleHasAreAnError) {
  Vehicle three;
  three.rotors.resize(3);
  EXPECT_THROW(flight_log_of(dataflash(), three, {}), InputError);
}

/// A stream of a bag: each field waves.
LogStream topic(const std::string& name, const std::vector<std::string>& fields, double step = 0.01) {
  const std::vector<double> t = times(0.0, step, static_cast<int>(std::lround(10 / step)));
  LogStream stream{.name = name, .clock = "", .t = t, .fields = {}};
  double phase = 0;
  for (const std::string& field : fields) stream.fields.push_back({field, "", 1.0, wave(t, 0, 0.5, ++phase)});
  return stream;
}

std::vector<std::string> pose(const std::string& of) {
  std::vector<std::string> fields;
  for (const char* axis : {"x", "y", "z"}) fields.push_back(of + "position." + axis);
  for (const char* axis : {"w", "x", "y", "z"}) fields.push_back(of + "orientation." + axis);
  return fields;
}

LogStream imu(const std::string& name) {
  std::vector<std::string> fields;
  for (const char* of : {"angular_velocity.", "linear_acceleration."})
    for (const char* axis : {"x", "y", "z"}) fields.push_back(std::string(of) + axis);
  LogStream stream = topic(name, fields);
  stream.fields.back().values = wave(stream.t, 9.8, 0.5, 1);  // up
  return stream;
}

/// Unit quaternions about one axis.
void turn(LogStream& stream, const std::string& of) {
  const auto values = [&](const char* axis) -> StoredValues& {
    const auto at = std::ranges::find(stream.fields, of + "orientation." + axis, &StreamField::name);
    return at->values;
  };
  std::vector<double> w, z, none(stream.t.size(), 0.0);
  for (const double t : stream.t) w.push_back(std::cos(0.1 * t)), z.push_back(std::sin(0.1 * t));
  values("w") = w, values("x") = none, values("y") = none, values("z") = z;
}

TEST(Profiles, ABagOfRosIsForwardLeftUp) {
  LogStream odometry = topic("/mavros/local_position/odom", pose("pose.pose."), 0.05);
  turn(odometry, "pose.pose.");
  LogStream speeds = topic("/mavros/esc_status", {});
  for (int n = 0; n < 4; ++n)
    speeds.fields.push_back(
        {"esc_status[" + std::to_string(n) + "].rpm", "", 1.0, wave(speeds.t, 6000, 300, n)});
  // A pose that is wanted, more often than the one that was, and the sticks of the remote control.
  const LogStream wanted = topic("/mavros/setpoint_position/local", pose("pose."), 0.01),
                  sticks = topic("/mavros/rc/in", {"channels[0]", "channels[1]"});
  const LogStreams bag{.file = "flight.mcap",
                       .format = "mcap",
                       .streams = {imu("/mavros/imu/data"), odometry, wanted, sticks, speeds}};
  const FlightLog log = flight_log_of(bag, Vehicle{}, {});
  const std::size_t i = row_at(log, 2.0);
  EXPECT_NEAR(log.w_B[1][i], -0.5 * std::sin(7 * 2.0 + 2), 1e-9);
  EXPECT_NEAR(log.f_B[2][i], -(9.8 + 0.5 * std::sin(7 * 2.0 + 1)), 1e-9);
  EXPECT_NEAR(log.x_W[0][i], bag.streams[1].find("pose.pose.position.y")->at(40), 1e-9);  // north is y
  EXPECT_NEAR(log.Omega[2][i], (6000 + 300 * std::sin(7 * 2.0 + 2)) * M_PI / 30, 1e-9);
  EXPECT_FALSE(log.has_commands());
  EXPECT_FALSE(log.has_velocity());
}

TEST(Profiles, ABagOfPx4IsReadAsItsLog) {
  LogStream gyro = topic("/fmu/out/sensor_combined", {"gyro_rad[0]", "gyro_rad[1]", "gyro_rad[2]"});
  LogStream motors = topic("/fmu/out/actuator_motors_v1", {});
  for (int n = 0; n < 12; ++n)
    motors.fields.push_back(
        {"control[" + std::to_string(n) + "]", "", 1.0,
         n < 4 ? wave(motors.t, 0.5, 0.1, n) : std::vector<double>(motors.t.size(), NAN)});
  const LogStreams bag{.file = "flight.db3", .format = "rosbag2", .streams = {gyro, motors}};
  const FlightLog log = flight_log_of(bag, Vehicle{}, {});
  ASSERT_EQ(log.delta.size(), 4U);
  const std::size_t i = row_at(log, 2.0);
  EXPECT_NEAR(log.delta[1][i], 0.5 + 0.1 * std::sin(7 * 2.0 + 1), 1e-9);
  EXPECT_NEAR(log.w_B[2][i], 0.5 * std::sin(7 * 2.0 + 3), 1e-9);  // forward, right, down as they are
}

}  // namespace
}  // namespace ident
