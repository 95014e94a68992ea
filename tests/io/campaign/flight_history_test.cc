// The history of a campaign's flights: as written, and undone.
#include "ident/io/campaign/flight_history.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "support/run_program.h"

namespace ident {
namespace {

FlightHistory history() {
  FlightHistory h;
  h.before.parameters = {{"kT", {6e-6, 3e-7}}, {"km", {800.0, 20.0}}, {"kQ", {9e-8, 1e-9}}};
  h.before.correlation = {{"kT", "km"}, Eigen::Matrix2d{{1, -0.5}, {-0.5, 1}}};
  h.after.parameters = {
      {"kT", {6.1e-6, 2e-7}}, {"km", {790.0, 15.0}}, {"kQ", {9e-8, 1e-9}}, {"Jxx", {3e-3, 1e-5}}};
  h.after.correlation = {{"kT", "km"}, Eigen::Matrix2d{{1, -0.99}, {-0.99, 1}}};
  h.logs = {{"it's one.csv", "00ff"}};
  h.earlier = {{"a.csv", "11"}, {"b: c.csv", "22"}};
  return h;
}

TEST(FlightHistory, ReadsAsItWasWritten) {
  const std::string folder = test_folder();
  EXPECT_FALSE(read_flight_history(folder));
  std::filesystem::create_directories(folder + "/.ident");
  const FlightHistory h = history();
  write_text(folder, ".ident/flights.yaml", flight_history_text(h));
  const FlightHistory read = read_flight_history(folder).value();
  EXPECT_EQ(vehicle_to_yaml(read.before), vehicle_to_yaml(h.before));
  EXPECT_EQ(vehicle_to_yaml(read.after), vehicle_to_yaml(h.after));
  ASSERT_EQ(read.logs.size(), 1U);
  EXPECT_EQ(read.logs[0].path, "it's one.csv");
  EXPECT_EQ(read.logs[0].sha256, "00ff");
  ASSERT_EQ(read.earlier.size(), 2U);
  EXPECT_EQ(read.earlier[1].path, "b: c.csv");
}

TEST(FlightHistory, UndoneIsWhatWasBefore) {
  const FlightHistory h = history();
  EXPECT_EQ(vehicle_to_yaml(h.undone(h.after)), vehicle_to_yaml(h.before));
}

TEST(FlightHistory, WhatWasChangedSinceStays) {
  const FlightHistory h = history();
  Vehicle now = h.after;
  now.parameters["kT"] = {6.2e-6, 1e-8};
  now.parameters["Jp"] = {1e-5, 1e-6};
  now.parameters.erase("kQ");
  now.correlation = {{"kT", "Jp"}, Eigen::Matrix2d{{1, 0.3}, {0.3, 1}}};
  const Vehicle before = h.undone(now);
  EXPECT_EQ(before.value("kT"), 6.2e-6);
  EXPECT_EQ(before.value("Jp"), 1e-5);
  EXPECT_EQ(before.value("km"), 800.0);
  EXPECT_FALSE(before.has("kQ")) << "taken out";
  EXPECT_FALSE(before.has("Jxx")) << "found by the flights";
  EXPECT_EQ(before.correlation.of("kT", "km"), 0.0) << "another kT";
  EXPECT_EQ(before.correlation.of("kT", "Jp"), 0.3);
}

}  // namespace
}  // namespace ident
