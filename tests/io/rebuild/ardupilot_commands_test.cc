// ArduPilot's demands through its mixer, against pulses that a copy of its laws made.
#include "ident/io/rebuild/ardupilot_commands.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "ident/io/log/read_flight_log.h"
#include "ident/io/rebuild/ardupilot_thrust.h"

namespace ident {
namespace {

constexpr double kLoop = 0.0025, kSeconds = 20.0;  // s

std::array<double, 4> demand(double t) {
  return {0.06 * std::sin(7 * t), 0.05 * std::sin(5.3 * t + 1), 0.03 * std::sin(2.9 * t),
          0.4 + 0.05 * std::sin(t)};
}

// A quadrotor X whose motor 1 is driven by output 4. `volts`: of the battery over the highest; `up`: us that
// are added to a pulse before it is cut to whole ones.
LogStreams flown(double volts = 1.0, double expo = 0.65, double up = 0.5) {
  LogStreams log{.file = "flight.bin", .format = "dataflash"};
  log.parameters = {{"FRAME_CLASS", 1},      {"FRAME_TYPE", 1},       {"MOT_PWM_MIN", 1000},
                    {"MOT_PWM_MAX", 2000},   {"MOT_SPIN_MIN", 0.15},  {"MOT_SPIN_MAX", 0.95},
                    {"MOT_THST_EXPO", expo}, {"SERVO4_FUNCTION", 33}, {"SERVO2_FUNCTION", 34},
                    {"SERVO3_FUNCTION", 35}, {"SERVO1_FUNCTION", 36}};
  if (volts != 1) log.parameters["MOT_BAT_VOLT_MAX"] = 16.8;
  // Motors 1 to 4: front right and rear left counter-clockwise, front left and rear right clockwise.
  constexpr double roll[] = {-0.5, 0.5, 0.5, -0.5}, pitch[] = {0.5, -0.5, 0.5, -0.5},
                   yaw[] = {0.5, 0.5, -0.5, -0.5};
  constexpr std::size_t output[] = {3, 1, 2, 0};
  std::vector<double> t_rate, t_rcou;
  std::array<std::vector<double>, 4> demands, pulses;
  for (int i = 0; i * kLoop < kSeconds; ++i) {
    const double t = 100 + i * kLoop;
    const auto u = demand(t);
    t_rate.push_back(t);
    for (std::size_t k = 0; k < 4; ++k) demands[k].push_back(u[k]);
    if (i % 40 != 0) continue;
    t_rcou.push_back(t + 0.0005);
    for (std::size_t n = 0; n < 4; ++n) {
      const double thrust = u[3] + roll[n] * u[0] + pitch[n] * u[1] + yaw[n] * u[2];
      const double ratio = ((0.65 - 1) + std::sqrt(0.35 * 0.35 + 4 * 0.65 * thrust)) / (2 * 0.65);
      pulses[output[n]].push_back(std::floor(1000 + 1000 * (0.15 + 0.8 * ratio / volts) + up));
    }
  }
  LogStream rate{.name = "RATE", .clock = "", .t = t_rate, .fields = {}},
      rcou{.name = "RCOU", .clock = "", .t = t_rcou, .fields = {}},
      motb{.name = "MOTB", .clock = "", .t = {100.0}, .fields = {}};
  constexpr const char* names[] = {"ROut", "POut", "YOut", "AOut"};
  for (std::size_t k = 0; k < 4; ++k) {
    rate.fields.push_back({names[k], "", 1.0, demands[k]});
    rcou.fields.push_back({fmt::format("C{}", k + 1), "us", 1.0, pulses[k]});
  }
  motb.fields = {{"LiftMax", "", 1.0, std::vector<double>{1.0}},
                 {"BatVolt", "", 1.0, std::vector<double>{volts}}};
  log.streams = {rate, rcou, motb};
  return log;
}

TEST(ArdupilotCommands, ThrustCurveIsInverted) {
  for (const double expo : {-0.3, 0.0, 0.65})
    for (const double thrust : {0.1, 0.4, 0.9}) {
      const ArdupilotCurve curve{expo, 0.15, 0.95};
      EXPECT_NEAR(curve.thrust(curve.command(thrust, 0.9, 0.95), 0.9, 0.95), thrust, 1e-12);
    }
}

TEST(ArdupilotCommands, AreThoseOfTheLoopToTheRoundingOfAPulse) {
  for (const double volts : {1.0, 0.9}) {
    LogStreams log = flown(volts);
    add_ardupilot_commands(log);
    const LogStream* rebuilt = log.find("motor_commands");
    ASSERT_NE(rebuilt, nullptr) << log.facts["commands"];
    ASSERT_EQ(rebuilt->fields.size(), 4U);
    EXPECT_GT(rebuilt->t.size(), 7000U);
    for (std::size_t i = 1; i < rebuilt->t.size(); ++i) ASSERT_GT(rebuilt->t[i], rebuilt->t[i - 1]);
    double most = 0;
    for (std::size_t i = 0; i < rebuilt->t.size(); ++i) {
      const double t = 100 + kLoop * std::floor((rebuilt->t[i] - 100 + 1e-9) / kLoop);
      const auto u = demand(t);
      const double thrust = u[3] - 0.5 * u[0] + 0.5 * u[1] + 0.5 * u[2];
      const double command = ArdupilotCurve{0.65, 0.15, 0.95}.command(thrust, 1, volts);
      most = std::max(most, std::abs(rebuilt->fields[0].at(i) - command));
    }
    EXPECT_LT(most, 6e-4);
  }
}

// Releases differ in how they make a whole number of a pulse; the pulses that were logged tell.
TEST(ArdupilotCommands, ArePulsesOfWholeMicrosecondsAsTheFirmwareMakesThem) {
  for (const double up : {0.0, 0.5}) {
    LogStreams log = flown(1.0, 0.65, up);
    add_ardupilot_commands(log);
    const LogStream* rebuilt = log.find("motor_commands");
    ASSERT_NE(rebuilt, nullptr) << log.facts["commands"];
    std::size_t off = 0;
    for (std::size_t i = 0; i < rebuilt->t.size(); ++i) {
      const auto u = demand(100 + kLoop * std::floor((rebuilt->t[i] - 100 + 1e-9) / kLoop));
      const double thrust = u[3] - 0.5 * u[0] + 0.5 * u[1] + 0.5 * u[2];
      const double pulse = std::floor(1000 * ArdupilotCurve{0.65, 0.15, 0.95}.command(thrust, 1, 1) + up);
      off += std::abs(1000 * rebuilt->fields[0].at(i) - pulse) > 1e-6;
    }
    EXPECT_LT(off, rebuilt->t.size() / 20) << up;
  }
}

TEST(ArdupilotCommands, OfAnotherCurveAreRefusedWithTheFigure) {
  LogStreams log = flown();
  log.parameters["MOT_SPIN_MIN"] = 0.05, log.parameters["MOT_THST_EXPO"] = -0.9;
  add_ardupilot_commands(log);
  EXPECT_EQ(log.find("motor_commands"), nullptr);
  EXPECT_NE(log.facts["commands"].find("more than 0.01"), std::string::npos) << log.facts["commands"];
}

TEST(ArdupilotCommands, DriveTheMotorsOfTheFlightLog) {
  LogStreams log = flown();
  LogStream imu{.name = "IMU", .clock = "", .t = log.find("RATE")->t, .fields = {}};
  std::vector<double> values;
  for (const double t : imu.t) values.push_back(std::sin(7 * t));
  for (const char* name : {"GyrX", "GyrY", "GyrZ"}) imu.fields.push_back({name, "rad/s", 1.0, values});
  log.streams.push_back(imu);
  add_ardupilot_commands(log);
  const FlightLog flight = flight_log_of(log, Vehicle{}, std::nullopt);
  ASSERT_EQ(flight.delta.size(), 4U);
  const auto u = demand(flight.t[400]);
  const double thrust = u[3] - 0.5 * u[0] + 0.5 * u[1] + 0.5 * u[2];
  EXPECT_NEAR(flight.delta[0][400], ArdupilotCurve({0.65, 0.15, 0.95}).command(thrust, 1, 1), 2e-3);
}

}  // namespace
}  // namespace ident
