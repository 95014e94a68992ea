// Correlations of a parameter file: as written, as read, and as results and files are laid over each other.
#include "ident/io/vehicle/vehicle_correlations.h"

#include <gtest/gtest.h>

#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "support/run_program.h"

namespace ident {
namespace {

// Names that a file spells otherwise, and mass, which has a key of its own.
Vehicle correlated() {
  Vehicle v = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  v.parameters["m"] = {0.5, 0.001};
  v.parameters["kT"] = {6e-6, 2e-7};
  v.parameters["rotor_mismatch.ratio@2"] = {0.97, 0.01};
  v.parameters["ground_effect.radius_sq"] = {0.01, 0.001};
  v.correlation.names = {"m", "kT", "rotor_mismatch.ratio@2", "ground_effect.radius_sq"};
  v.correlation.matrix = Eigen::MatrixXd::Identity(4, 4);
  v.correlation.matrix(0, 1) = v.correlation.matrix(1, 0) = 1 - 1e-13;
  v.correlation.matrix(1, 3) = v.correlation.matrix(3, 1) = -1.0 / 3e8;
  v.correlation.matrix(2, 3) = v.correlation.matrix(3, 2) = 0.25;
  return v;
}

TEST(VehicleCorrelations, ReadAsTheyWereWritten) {
  const Vehicle v = correlated();
  const std::string file = test_folder() + "/correlated.yaml";
  write_vehicle(file, v);
  const Correlation read = read_vehicle(file).correlation;
  EXPECT_EQ(read.names.size(), 4U);
  for (const std::string& a : v.correlation.names)
    for (const std::string& b : v.correlation.names)
      EXPECT_EQ(read.of(a, b), v.correlation.of(a, b)) << a << " " << b;
}

TEST(VehicleCorrelations, AreWrittenOfWhatIsWrittenOnly) {
  Vehicle v = correlated();
  v.parameters["m"].std.reset();
  v.parameters.erase("rotor_mismatch.ratio@2");
  const std::string text = vehicle_to_yaml(v);
  EXPECT_NE(text.find("correlations:\n  kT: {ground_effect.radius: -3.33"), std::string::npos) << text;
  EXPECT_EQ(text.find("  m: {"), std::string::npos) << text;
  v.correlation = {};
  EXPECT_EQ(vehicle_to_yaml(v).find("correlations"), std::string::npos);
}

TEST(VehicleCorrelations, NamesAreThoseThatTheFileHas) {
  const std::string file = write_text(test_folder(), "keys.yaml",
                                      "mass: {value: 0.5, std: 0.001}\n"
                                      "arm: {value: 0.17, std: 0.001}\n"
                                      "layout: 4sp\n"
                                      "slant_deg: {value: 5.7, std: 0.1}\n"
                                      "parameters:\n"
                                      "  rotor_mismatch.rotor: 2\n"
                                      "  rotor_mismatch.ratio: {value: 0.97, std: 0.01}\n"
                                      "correlations:\n"
                                      "  mass: {arm: 0.1, slant_deg: 0.2, rotor_mismatch.ratio: 0.3}\n");
  const Correlation read = read_vehicle(file).correlation;
  EXPECT_EQ(read.of("m", "l"), 0.1);
  EXPECT_EQ(read.of("m", "alpha"), 0.2);
  EXPECT_EQ(read.of("m", "rotor_mismatch.ratio@2"), 0.3);
}

// As a parameter file out of which somebody took a line.
TEST(VehicleCorrelations, OfWhatAFileDoesNotStateAreLeftOut) {
  const std::string file = write_text(test_folder(), "shorter.yaml",
                                      "parameters:\n"
                                      "  kT: {value: 6e-6, std: 2e-7}\n"
                                      "  kQ: {value: 9e-8, std: 2e-9}\n"
                                      "  km: 800\n"
                                      "correlations:\n"
                                      "  kT: {km: -0.9, kQ: 0.5, Jxx: 0.3}\n"
                                      "  km: {kQ: 0.2, Jxx: 0.1}\n");
  const Vehicle read = read_vehicle(file);
  EXPECT_EQ(read.correlation.names, (std::vector<std::string>{"kT", "kQ"}));
  ASSERT_EQ(read.warnings.size(), 2U);  // one for each name
  EXPECT_NE(read.warnings[0].message.find("no standard deviation of km"), std::string::npos);
  EXPECT_NE(read.warnings[1].message.find("no standard deviation of Jxx"), std::string::npos);
}

Result found(const std::vector<std::string>& names, double r) {
  Result result;
  const auto n = static_cast<Eigen::Index>(names.size());
  for (const std::string& name : names) result.parameters.push_back({.name = name, .value = 2.0, .std = 0.1});
  result.correlation = {names, Eigen::MatrixXd::Constant(n, n, r)};
  result.correlation.matrix.diagonal().setOnes();
  return result;
}

// What is measured anew knows nothing of what it was known with before.
TEST(VehicleCorrelations, AResultReplacesThoseOfWhatItFound) {
  Vehicle v = with_result({}, found({"kT", "kQ", "km", "omega_m"}, 0.5));
  EXPECT_EQ(v.correlation.of("kT", "km"), 0.5);
  v = with_result(v, found({"kT", "kQ"}, 0.2));
  EXPECT_EQ(v.correlation.of("kT", "kQ"), 0.2);
  EXPECT_EQ(v.correlation.of("kT", "km"), 0.0);
  EXPECT_EQ(v.correlation.of("km", "omega_m"), 0.5);
}

TEST(VehicleCorrelations, OfWhatAResultDoesNotStoreNothingIsKept) {
  Result result = found({"kT", "kQ", "km"}, 0.5);
  result.parameters[2].doubt("not to be believed");
  const Vehicle v = with_result({}, result);
  EXPECT_EQ(v.correlation.names, (std::vector<std::string>{"kT", "kQ"}));
}

// Thrust goes with kT km^2: with kT back at what was stated, the km found beside another kT is not stored.
TEST(VehicleCorrelations, WhatIsStoredIsItsMeanBesideWhatGoesBackToTheStated) {
  Result result = found({"kT", "km"}, -0.9999);
  result.parameters[0].value = 1.2, result.parameters[0].std = 0.12, result.parameters[0].prior_value = 1.0;
  result.parameters[1].value = 0.9, result.parameters[1].std = 0.045;
  EXPECT_EQ(with_result({}, result).value("km"), 0.9);
  result.parameters[0].doubt("not to be believed");
  const Vehicle v = with_result({}, result);
  EXPECT_FALSE(v.has("kT"));
  EXPECT_NEAR(v.value("km") * v.value("km"), 1.2 * 0.9 * 0.9, 1e-3);
}

TEST(VehicleCorrelations, TheParameterFileWins) {
  const Vehicle stated = with_result({}, found({"kT", "kQ", "km"}, 0.5));
  const Vehicle both = with_parameters(stated, with_result({}, found({"kT", "Jxx"}, 0.1)));
  EXPECT_EQ(both.correlation.of("kT", "Jxx"), 0.1);
  EXPECT_EQ(both.correlation.of("kT", "kQ"), 0.0);
  EXPECT_EQ(both.correlation.of("kQ", "km"), 0.5);
}

}  // namespace
}  // namespace ident
