// Rotors that jump as no command says: a diagnosis goes by their speeds, and finds what it finds without.
#include <gtest/gtest.h>

#include "ident/gap/diagnose.h"
#include "support/jumping_speeds.h"

namespace ident {
namespace {

std::vector<FlightLog> flown(const Vehicle& truth, double jumps) {
  return {testing::with_jumping_speeds(truth, jumps, 1.0, 3),
          testing::with_jumping_speeds(truth, jumps, 1.0, 4)};
}

std::string status(const Diagnosis& seen) {
  return seen.result.extra["verdict"]["status"].get<std::string>();
}

TEST(DiagnoseJitter, NothingElseIsNone) {
  const Diagnosis seen = diagnose_gap(testing::known(testing::quad()), flown(testing::quad(), 5.0));
  EXPECT_TRUE(seen.result.has_warning("speeds_jitter"));
  EXPECT_FALSE(seen.result.has_warning("speeds_as_input"));
  EXPECT_EQ(status(seen), "none") << seen.result.verdict;
}

TEST(DiagnoseJitter, WhatIsMissingIsFound) {
  Vehicle truth = testing::quad();
  truth.parameters["rotor_mismatch.ratio@2"] = {0.9, {}};
  const Diagnosis seen = diagnose_gap(testing::known(testing::quad()), flown(truth, 5.0));
  EXPECT_TRUE(seen.result.has_warning("speeds_jitter"));
  EXPECT_EQ(status(seen), "identified") << seen.result.verdict;
  EXPECT_EQ(seen.result.extra["verdict"]["effects"][0], "rotor_mismatch") << seen.result.verdict;
}

TEST(DiagnoseJitter, NoiseOfASensorIsNoReason) {
  const Diagnosis seen = diagnose_gap(testing::known(testing::quad()), flown(testing::quad(), 0.0));
  EXPECT_FALSE(seen.result.has_warning("speeds_jitter"));
  EXPECT_EQ(status(seen), "none") << seen.result.verdict;
}

}  // namespace
}  // namespace ident
