// Filters and loop of Betaflight from the lines of its header.
#include "ident/io/blackbox/derived_settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "ident/io/blackbox/format.h"

namespace ident {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

LogStreams with(const std::string& lines) {
  const std::string text =
      "H Product:Blackbox flight data recorder by Nicholas Sherlock\nH Data version:2\n"
      "H Field I name:loopIteration,time,gyroADC[0]\nH Field I signed:0,0,1\nH Field I predictor:0,0,0\n"
      "H Field I encoding:1,1,0\nH Field P predictor:6,2,3\nH Field P encoding:9,0,0\n"
      "H I interval:4\nH P interval:1/1\n" +
      lines;
  return BlackboxFormat::read(text + std::string("I\0\144\0E\377End of log\0", 17), "log");
}

// A filter counts to second order: its lag is exact.
TEST(DerivedSettings, LowPassesAreThoseOfTheFirmware) {
  const LogStreams v45 = with(
      "H Firmware revision:Betaflight 4.5.1 (abc) X\nH acc_lpf_hz:2500\nH gyro_lpf1_type:0\n"
      "H gyro_lpf1_static_hz:250\nH gyro_lpf1_dyn_hz:0,500\nH gyro_lpf2_type:2\n"
      "H gyro_lpf2_static_hz:500\nH looptime:125\nH pid_process_denom:2\n");
  const double pt2 = 1 / std::sqrt(std::numbers::sqrt2 - 1);
  EXPECT_NEAR(*v45.parameter("ident_acc_lag"), 2 / (kTurn * pt2 * 25), 1e-12);
  EXPECT_NEAR(*v45.parameter("ident_acc_square"), 1 / std::pow(kTurn * pt2 * 25, 2), 1e-15);
  EXPECT_NEAR(*v45.parameter("ident_gyro_lag"), 1 / (kTurn * 250) + 2 / (kTurn * pt2 * 500), 1e-12);
  EXPECT_DOUBLE_EQ(*v45.parameter("ident_loop_hz"), 4000);
}

TEST(DerivedSettings, FollowTheVersion) {
  const LogStreams v42 = with(
      "H Firmware revision:Betaflight 4.2.0 (abc) X\nH acc_lpf_hz:1000\nH gyro_lowpass_type:0\n"
      "H gyro_lowpass_hz:200\nH gyro_lowpass_dyn_hz:240,600\nH gyro_lowpass2_type:1\n"
      "H gyro_lowpass2_hz:300\n");
  EXPECT_NEAR(*v42.parameter("ident_acc_lag"), std::numbers::sqrt2 / (kTurn * 10), 1e-12);
  // Of the dynamic one the middle of its range.
  EXPECT_NEAR(*v42.parameter("ident_gyro_lag"), 1 / (kTurn * 420) + std::numbers::sqrt2 / (kTurn * 300),
              1e-12);
  const LogStreams off = with("H Firmware revision:Betaflight 4.5.1 (abc) X\nH acc_lpf_hz:0\n");
  EXPECT_FALSE(off.parameter("ident_acc_lag").has_value());
  EXPECT_FALSE(off.parameter("ident_gyro_lag").has_value());
}

}  // namespace
}  // namespace ident
