// Logs as other programs write them: elements of vectors in brackets, seconds since 1970.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "ident/core/error.h"
#include "ident/io/csv/units.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"
#include "support/published_hover.h"

namespace ident {
namespace {

/// A file that is gone when it is left.
class Written {
 public:
  Written(const std::string& name, const std::string& text)
      : path_(std::filesystem::temp_directory_path() / fmt::format("ident-{}-{}", ::getpid(), name)) {
    std::ofstream(path_) << text;
  }
  ~Written() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// Two seconds at 100 Hz from `begin`, rates in the columns gyro[0] to gyro[2].
std::string some_flight(long long begin) {
  std::string text = "stamp,gyro[0],gyro[1],gyro[2],az,out[0],out[1],out[2],out[3]\n";
  for (int i = 0; i < 200; ++i)
    text += fmt::format("{},{:.4f},{:.4f},{:.4f},{:.3f},0.5,0.5,0.5,{:.3f}\n",
                        begin * 1'000'000'000 + 10'000'000LL * i, 0.1 * std::sin(0.1 * i),
                        0.2 * std::sin(0.1 * i), 0.3 * std::cos(0.1 * i), -9.81 + 0.1 * std::sin(0.3 * i),
                        0.5 + 0.01 * std::sin(0.2 * i));
  return text;
}

std::string map_of(const std::string& windows) {
  return "columns:\n  t: {column: stamp, unit: ns}\n  p: \"gyro[0]\"\n  q: \"gyro[1]\"\n  r: \"gyro[2]\"\n"
         "  az: az\n  delta1: \"out[0]\"\n  delta2: \"out[1]\"\n  delta3: \"out[2]\"\n  delta4: \"out[3]\"\n"
         "frames: {body: frd, world: ned}\n" +
         windows;
}

FlightLog read(long long begin, const std::string& windows = {}) {
  const Written log("log.csv", some_flight(begin)), map("map.yaml", map_of(windows));
  return read_flight_log(log.path(), testing::published_vehicle(), read_log_map(map.path()));
}

TEST(ForeignLog, DigitsInBracketsBehindANameAreNoUnit) {
  EXPECT_EQ(split_header("gyro_rad[0]").name, "gyro_rad[0]");
  EXPECT_FALSE(split_header("gyro_rad[0]").unit);
  EXPECT_EQ(split_header("ratio [1]").unit, "1");
  EXPECT_EQ(split_header("p [deg/s]").unit, "deg/s");
  const FlightLog log = read(0);
  EXPECT_NEAR(log.w_B[1][10], 0.2 * std::sin(1.0), 1e-4);
  EXPECT_NEAR(log.delta[3][5], 0.5 + 0.01 * std::sin(1.0), 1e-3);
}

TEST(ForeignLog, TheUnitOneNeedsNoBlank) {
  std::string text = some_flight(0);
  text.replace(0, text.find('\n'), "t [ns],p,q,r,az,delta1[1],delta2(1),delta3 [1],delta4[-]");
  const Written log("one.csv", text);
  EXPECT_NEAR(read_flight_log(log.path(), testing::published_vehicle(), {}).delta[3][5],
              0.5 + 0.01 * std::sin(1.0), 1e-3);
}

TEST(ForeignLog, SecondsSince1970CountFromTheBeginning) {
  const FlightLog log = read(1'700'000'000, "windows: [[1700000000.5, 1700000001.5]]\n");
  EXPECT_NEAR(log.t[123], 1.23, 1e-6);
  EXPECT_TRUE(std::ranges::any_of(log.notices, [](const std::string& notice) {
    return notice.find("times count from 1700000000 s of the log") != std::string::npos;
  }));
  ASSERT_EQ(log.windows.size(), 1u);
  EXPECT_NEAR(log.windows[0][0], 0.5, 1e-6);
  EXPECT_NEAR(log.windows[0][1], 1.5, 1e-6);
  EXPECT_NEAR(read(1'700'000'000, "windows: [[0.5, 1.5]]\n").windows[0][0], 0.5, 1e-6);
  const std::string before = "windows: [[1699999990, 1700000001.5]]\n";  // begins before the log does
  EXPECT_NEAR(read(1'700'000'000, before).windows[0][1], 1.5, 1e-6);
  EXPECT_THROW(read(1'700'000'000, "windows: [[1700000007, 1700000008]]\n"), InputError);
  EXPECT_NEAR(read(86'000).t[0], 86'000, 1e-6);  // a day that a processor has been on
}

TEST(ForeignLog, SpeedsThatAreHeldBetweenTheirSamplesCountOnce) {
  std::string text = "t,p,q,r,az,omega1,omega2,omega3,omega4\n";
  for (int i = 0; i < 200; ++i) {
    const double speed = 700 + std::sin(1.0 * (i / 5));
    text += fmt::format("{:.2f},{:.4f},0.01,0.02,{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n", 0.01 * i,
                        0.1 * std::sin(0.1 * i), -9.81 + 0.1 * std::sin(0.3 * i), speed, speed + 1, speed - 2,
                        speed + 3);
  }
  const Written file("held.csv", text);
  const FlightLog log = read_flight_log(file.path(), testing::published_vehicle(), {});
  EXPECT_TRUE(std::ranges::any_of(log.warnings, [](const Warning& w) {
    return w.code == "held_samples" && w.message.find("rotor speeds: 80 %") != std::string::npos;
  }));
  EXPECT_EQ(std::ranges::count_if(log.Omega[2], [](double x) { return std::isfinite(x); }), 40);
}

}  // namespace
}  // namespace ident
