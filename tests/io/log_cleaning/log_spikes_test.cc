// Single values in a log that cannot belong to the flight.
#include "ident/io/log_cleaning/log_spikes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ident {
namespace {

FlightLog log_of(std::size_t rows) {
  FlightLog log;
  log.file = "log.csv";
  for (std::size_t i = 0; i < rows; ++i) log.t.push_back(0.01 * static_cast<double>(i));
  return log;
}

TEST(LogSpikes, ACommandOfAnotherKindIsTakenOutAndNamed) {
  FlightLog log = log_of(400);
  log.delta = {std::vector<double>(400, 0.4)};
  log.delta[0][100] = 1e30, log.delta[0][200] = 1.0, log.delta[0][201] = 0.0;
  drop_impossible(log, log.delta, "commands");
  EXPECT_TRUE(std::isnan(log.delta[0][100]));
  EXPECT_EQ(log.delta[0][200], 1.0);  // a command may jump for one sample
  EXPECT_EQ(log.delta[0][201], 0.0);
  ASSERT_EQ(log.warnings.size(), 1U);
  EXPECT_EQ(log.warnings[0].code, "spikes");
  EXPECT_NE(log.warnings[0].message.find("t = 1 s"), std::string::npos) << log.warnings[0].message;
}

TEST(LogSpikes, MotorsThatMostlyRestKeepTheirCommands) {
  FlightLog log = log_of(400);
  log.delta = {std::vector<double>(400, 0.0)};
  for (std::size_t i = 300; i < 400; ++i) log.delta[0][i] = 0.6;
  const std::vector<double> before = log.delta[0];
  drop_impossible(log, log.delta, "commands");
  EXPECT_EQ(log.delta[0], before);
  EXPECT_TRUE(log.warnings.empty());
}

TEST(LogSpikes, ASensorThatJumpsForOneSampleIsASpike) {
  FlightLog log = log_of(400);
  std::vector<std::vector<double>> speed(1);
  for (const double t : log.t) speed[0].push_back(800 + 30 * std::sin(4 * t));
  speed[0][50] = 5000;
  drop_spikes(log, speed, "rotor speeds");
  EXPECT_TRUE(std::isnan(speed[0][50]));
  EXPECT_EQ(log.warnings.size(), 1U);
}

// Rotors need longer than some milliseconds to turn a vehicle, and so to and fro.
TEST(LogSpikes, WhatComesAndGoesWithinMillisecondsIsNoMotion) {
  FlightLog log;
  log.file = "log.csv";
  std::vector<std::vector<double>> rate(1);
  for (int i = 0; i < 4000; ++i) {
    log.t.push_back(0.001 * i);
    rate[0].push_back(std::sin(5 * log.t.back()) + 0.02 * std::sin(1e4 * i));
  }
  for (std::size_t i = 1000; i < 1005; ++i) rate[0][i] += 4.0;
  for (std::size_t i = 2000; i < 2040; ++i) rate[0][i] += 4.0;  // a blow, for all that is known
  drop_spikes(log, rate, "p q r");
  for (std::size_t i = 990; i < 1015; ++i) EXPECT_EQ(std::isnan(rate[0][i]), i >= 1000 && i < 1005) << i;
  EXPECT_FALSE(std::isnan(rate[0][2020]));
  ASSERT_EQ(log.warnings.size(), 1U);
  EXPECT_NE(log.warnings[0].message.find("t = 1 s"), std::string::npos) << log.warnings[0].message;
}

}  // namespace
}  // namespace ident
