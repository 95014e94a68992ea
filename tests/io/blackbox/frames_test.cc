// Logs written by hand: predictors, GPS, pauses, several logs, damage.
#include <gtest/gtest.h>

#include <string>

#include "ident/core/error.h"
#include "ident/io/blackbox/csv_format.h"
#include "ident/io/blackbox/format.h"

namespace ident {
namespace {

const std::string start = "H Product:Blackbox flight data recorder by Nicholas Sherlock\nH Data version:2\n";

/// Fields loopIteration, time, a gyro (average of two before), motors (min motor, motor 0).
const std::string fields =
    "H Field I name:loopIteration,time,gyroADC[0],motor[0],motor[1]\n"
    "H Field I signed:0,0,1,0,0\n"
    "H Field I predictor:0,0,0,11,5\n"
    "H Field I encoding:1,1,0,1,0\n"
    "H Field P predictor:6,2,3,1,1\n"
    "H Field P encoding:9,0,0,0,0\n"
    "H I interval:4\nH P interval:1/1\nH motorOutput:48,2047\nH Firmware revision:Betaflight 4.5.1 (abc) X\n";

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

const std::string end = bytes({'E', 255}) + std::string("End of log\0", 11);

std::vector<double> values(const LogStreams& log, const std::string& stream, const std::string& field) {
  const LogStream* found = log.find(stream);
  const StreamField* column = found ? found->find(field) : nullptr;
  std::vector<double> all;
  for (std::size_t i = 0; column && i < column->size(); ++i) all.push_back(column->at(i));
  return all;
}

using Numbers = std::vector<double>;

TEST(BlackboxFrames, PredictionsAreAdded) {
  // I: iteration 0, 100 us, gyro 10 (zigzag 20), motor 48 + 2, motor 1 = motor 0 - 1.
  // P: +1; 2*100-100 + 5; (10+10)/2 - 3; 50 + 1; 49 + 0.
  // P: +1; 2*105-100 + 0; (7+10)/2 = 8, + 0; 51; 49 - 1.
  const std::string log =
      start + fields + bytes({'I', 0, 100, 20, 2, 1, 'P', 10, 5, 2, 0, 'P', 0, 0, 0, 1}) + end;
  const LogStreams streams = BlackboxFormat::read(log, "log");
  EXPECT_EQ(values(streams, "1:main", "loopIteration"), (Numbers{0, 1, 2}));
  EXPECT_EQ(values(streams, "1:main", "time (us)"), (Numbers{100, 105, 110}));
  EXPECT_EQ(values(streams, "1:main", "gyroADC[0]"), (Numbers{10, 7, 8}));
  EXPECT_EQ(values(streams, "1:main", "motor[0]"), (Numbers{50, 51, 51}));
  EXPECT_EQ(values(streams, "1:main", "motor[1]"), (Numbers{49, 49, 48}));
  EXPECT_NEAR(streams.find("1:main")->t[2], 10e-6, 1e-15);
  EXPECT_TRUE(streams.damage.empty()) << streams.damage.front();
  EXPECT_EQ(streams.parameter("motorOutput[1]"), 2047.0);
  EXPECT_EQ(streams.facts.at("Firmware revision"), "Betaflight 4.5.1 (abc) X");
}

TEST(BlackboxFrames, GpsIsRelativeToHomeAndToTheLastMainFrame) {
  const std::string gps =
      "H Field H name:GPS_home[0],GPS_home[1]\nH Field H signed:1,1\nH Field H predictor:0,0\n"
      "H Field H encoding:0,0\nH Field G name:time,GPS_numSat,GPS_coord[0],GPS_coord[1],GPS_speed\n"
      "H Field G signed:0,0,1,1,0\nH Field G predictor:10,0,7,7,0\nH Field G encoding:1,1,0,0,1\n";
  // Home at 32, -16 (in 1e-7 deg); a fix 7 us after the main frame, 9 satellites, +1 and -1 from home, 50
  // cm/s. A fix before the home position is known is not given.
  const std::string frames =
      bytes({'I', 0, 100, 0, 0, 0, 'G', 7, 9, 2, 1, 50, 'H', 64, 31, 'G', 7, 9, 2, 1, 50});
  const LogStreams streams = BlackboxFormat::read(start + fields + gps + frames + end, "log");
  EXPECT_EQ(values(streams, "1:gps", "time (us)"), (Numbers{107}));
  EXPECT_EQ(values(streams, "1:gps", "GPS_coord[0]"), (Numbers{33 * 1e-7}));
  EXPECT_EQ(values(streams, "1:gps", "GPS_coord[1]"), (Numbers{-17 * 1e-7}));
  EXPECT_EQ(values(streams, "1:gps", "GPS_speed (m/s)"), (Numbers{0.5}));
}

TEST(BlackboxFrames, AreNotCountedFromDamageToTheNextIntraFrame) {
  const std::string whole = bytes({'I', 0, 100, 0, 0, 0, 'P', 10, 0, 0, 0});
  const std::string later = bytes({'P', 0, 0, 0, 0, 'I', 4, 120, 0, 0, 0, 'P', 10, 0, 0, 0});
  const LogStreams streams = BlackboxFormat::read(start + fields + whole + bytes({1}) + later + end, "log");
  EXPECT_EQ(values(streams, "1:main", "time (us)"), (Numbers{100, 105, 120, 125}));
  ASSERT_EQ(streams.dropouts.size(), 1u);
  EXPECT_NEAR(streams.dropouts[0][0], 5e-6, 1e-15);
  EXPECT_NEAR(streams.dropouts[0][1], 20e-6, 1e-15);
  EXPECT_EQ(streams.damage.size(), 1u);
}

TEST(BlackboxFrames, GoOnAfterAPauseThatTheLogAnnounces) {
  // Resumed at iteration 10000 (0x90 0x4e), 20 s later (20,000,100 = 0xe4 0xda 0xc4 0x09): steps that are too
  // long for frames that follow each other.
  const std::string pause = bytes({'E', 14, 0x90, 0x4e, 0xe4, 0xda, 0xc4, 0x09});
  const std::string after = bytes({'I', 0x90, 0x4e, 0xe4, 0xda, 0xc4, 0x09, 0, 0, 0});
  const std::string before = bytes({'I', 0, 100, 0, 0, 0});
  EXPECT_EQ(values(BlackboxFormat::read(start + fields + before + pause + after + end, "log"), "1:main",
                   "time (us)"),
            (Numbers{100, 20000100}));
  EXPECT_EQ(values(BlackboxFormat::read(start + fields + before + after + end, "log"), "1:main", "time (us)"),
            (Numbers{100}));
}

TEST(BlackboxFrames, TimeGoesOnWhereItsClockOf32BitsTurns) {
  // 0xfffffff0 us, then 0x20 later.
  const std::string frames = bytes({'I', 0, 0xf0, 0xff, 0xff, 0xff, 0x0f, 0, 0, 0, 'I', 4, 0x10, 0, 0, 0});
  EXPECT_EQ(values(BlackboxFormat::read(start + fields + frames + end, "log"), "1:main", "time (us)"),
            (Numbers{4294967280.0, 4294967312.0}));
}

TEST(BlackboxFrames, OfEachLogInAFileAreStreamsOfTheirOwn) {
  const std::string one = start + fields + bytes({'I', 0, 100, 0, 0, 0}) + end;
  const std::string two = start + "H looptime:125\n" + fields + bytes({'I', 0, 120, 2, 0, 0}) + end;
  const LogStreams streams = BlackboxFormat::read(one + two, "log");
  EXPECT_EQ(values(streams, "1:main", "time (us)"), (Numbers{100}));
  EXPECT_EQ(values(streams, "2:main", "gyroADC[0]"), (Numbers{1}));
  EXPECT_NEAR(streams.find("2:main")->t[0], 20e-6, 1e-15);
  EXPECT_EQ(streams.parameter("2:looptime"), 125.0);
}

void expect_refused(const std::string& log, const std::string& words) {
  try {
    BlackboxFormat::read(log, "log");
    ADD_FAILURE() << "read, not refused: " << words;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(BlackboxFrames, OfAHeaderThatCannotBeReadAreRefused) {
  expect_refused(start, "ends within its header");
  expect_refused(start + "H Firmware type:Cleanflight\nI", "does not name the fields");
  expect_refused(start + fields + "H Field P encoding:9,0,4,0,0\nI",
                 "gyroADC[0] has encoding 4, which is not known");
  expect_refused(start + fields + "H Field P predictor:6,12,0,0,0\nI",
                 "time has predictor 12, which is not known");
  expect_refused(start + fields + "P", "no main frame");
}

TEST(BlackboxCsv, HasTheColumnsOfTheDecodersOutput) {
  const std::string decoded =
      "loopIteration, time (us), gyroADC[0], vbatLatest (V), flightModeFlags (flags)\n"
      "0, 100, -3, 16.51, ANGLE_MODE\n1, 1100, 4, 16.50, 0\n2, 12";
  const LogStreams streams = BlackboxCsvFormat::read(decoded, "log.csv");
  EXPECT_EQ(values(streams, "1:main", "gyroADC[0]"), (Numbers{-3, 4}));
  EXPECT_EQ(streams.find("1:main")->find("vbatLatest (V)")->unit, "V");
  EXPECT_EQ(streams.find("1:main")->find("flightModeFlags (flags)"), nullptr);
  EXPECT_NEAR(streams.find("1:main")->t[1], 1e-3, 1e-15);
  EXPECT_EQ(streams.damage.size(), 1u);  // the last line is cut off
}

TEST(BlackboxCsv, OfTheExplorerBringsTheHeader) {
  const std::string exported =
      "\"Product\",\"Blackbox flight data recorder by Nicholas Sherlock\"\n\"acc_1G\",\"2048\"\n"
      "\"loopIteration\",\"time\",\"accSmooth[2]\"\n0,100,2048\n1,600,2050\n";
  const LogStreams streams = BlackboxCsvFormat::read(exported, "log.csv");
  EXPECT_EQ(streams.parameter("acc_1G"), 2048.0);
  EXPECT_EQ(values(streams, "1:main", "accSmooth[2]"), (Numbers{2048, 2050}));
}

}  // namespace
}  // namespace ident
