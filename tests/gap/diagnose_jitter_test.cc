// Rotors that jump as no command says: a diagnosis says so, and names what is plain all the same.
#include <gtest/gtest.h>

#include "ident/gap/diagnose.h"
#include "support/jumping_speeds.h"

namespace ident {
namespace {

Diagnosis seen_of(const Vehicle& truth, double jumps) {
  const std::vector<FlightLog> logs = {testing::with_jumping_speeds(truth, jumps, 1.0, 3),
                                       testing::with_jumping_speeds(truth, jumps, 1.0, 4)};
  return diagnose_gap(testing::known(testing::quad()), logs);
}

std::string status(const Diagnosis& seen) {
  return seen.result.extra["verdict"]["status"].get<std::string>();
}

TEST(DiagnoseJitter, AloneIsUnknownAndSaidToBeThere) {
  const Diagnosis seen = seen_of(testing::quad(), 20.0);
  EXPECT_TRUE(seen.result.has_warning("speeds_jitter"));
  EXPECT_EQ(status(seen), "unknown");
  EXPECT_NE(seen.result.verdict.find("jump from row to row"), std::string::npos) << seen.result.verdict;
}

TEST(DiagnoseJitter, WhatIsPlainIsNamedWithoutIt) {
  Vehicle truth = testing::quad();
  truth.parameters["rotor_mismatch.ratio@2"] = {0.9, {}};
  const Diagnosis seen = seen_of(truth, 20.0);
  EXPECT_TRUE(seen.result.has_warning("speeds_jitter"));
  EXPECT_EQ(status(seen), "identified") << seen.result.verdict;
  EXPECT_EQ(seen.result.extra["verdict"]["effects"][0], "rotor_mismatch") << seen.result.verdict;
  EXPECT_EQ(seen.result.verdict.find("jump"), std::string::npos) << seen.result.verdict;
}

TEST(DiagnoseJitter, NoiseOfASensorIsNotCalledThat) {
  const Diagnosis seen = seen_of(testing::quad(), 0.0);
  EXPECT_FALSE(seen.result.has_warning("speeds_jitter"));
  EXPECT_EQ(status(seen), "none") << seen.result.verdict;
}

}  // namespace
}  // namespace ident
