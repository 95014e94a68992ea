// What a patch changes, in the format's own names.
#include "ident/io/simulators/changes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ident/io/simulators/patch.h"
#include "io/simulators/simulator_vehicles.h"

namespace ident {
namespace {

using test::plain_quadrotor;

std::string page(const char* target, const Vehicle& vehicle) {
  return export_to_simulator(find_simulator(target), vehicle).text;
}

TEST(FileChanges, AreListedOnceForAllRotors) {
  Vehicle better = plain_quadrotor();
  better.parameters["kT"] = {6.4e-6, 3e-8};
  const SimulatorFormat& gz = find_simulator("gz");
  const std::string before = page("gz", plain_quadrotor()),
                    after = patch_simulator(gz, before, "model.sdf", better).text;
  const std::vector<FileChange> changes = file_changes(gz, before, after, "model.sdf", better);
  const auto thrust = std::ranges::find(changes, "motorConstant", &FileChange::name);
  ASSERT_NE(thrust, changes.end());
  EXPECT_DOUBLE_EQ(thrust->before.value_or(0), 6.1e-6);
  EXPECT_DOUBLE_EQ(thrust->after, 6.4e-6);
  EXPECT_NEAR(thrust->std.value_or(0), 3e-8, 1e-12);
  // kQ stays, kQ/kT does not.
  EXPECT_EQ(std::ranges::count(changes, "momentConstant", &FileChange::name), 1);
  EXPECT_EQ(changes.size(), 2U);
}

TEST(FileChanges, OfRotorsThatDifferAreListedOneByOne) {
  Vehicle better = plain_quadrotor();
  better.parameters["rotor_mismatch.ratio@2"] = {0.9, 0.01};
  const SimulatorFormat& gz = find_simulator("gz");
  const std::string before = page("gz", plain_quadrotor()),
                    after = patch_simulator(gz, before, "model.sdf", better).text;
  const std::vector<FileChange> changes = file_changes(gz, before, after, "model.sdf", better);
  EXPECT_EQ(std::ranges::count(changes, "rotor2.motorConstant", &FileChange::name), 1);
  EXPECT_EQ(std::ranges::count(changes, "rotor1.motorConstant", &FileChange::name), 0);
}

// A file that an export would write otherwise: the time constant stands there with one more per mille.
TEST(FileChanges, WhatDoesNotDifferBetweenTheVehiclesStaysAsItStands) {
  const SimulatorFormat& format = find_simulator("rotorpy");
  const Vehicle stated = plain_quadrotor();
  std::string text = page("rotorpy", stated);
  const std::size_t at = text.find("'tau_m': ") + 9;
  text.replace(at, text.find(',', at) - at, "0.0305");
  Vehicle better = stated;
  better.parameters["kT"].value = 6.4e-6;
  const std::string patched = patch_simulator(format, text, "params.py", better, &stated).text;
  EXPECT_NE(patched.find("'tau_m': 0.0305,"), std::string::npos);
  EXPECT_NE(patched.find("'k_eta': 6.4e-06,"), std::string::npos);
}

}  // namespace
}  // namespace ident
