// A cause that stands in for one that was left out of the search.
#include "ident/gap/search/left_out.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/diagnosed.h"

namespace ident {
namespace {

using testing::flight_of;
using testing::published_vehicle;

Judged without(const std::vector<std::string>& left_out, const Vehicle& model, const FlightLog& log) {
  const std::vector<FlightLog> logs{log};
  GapOptions options;
  options.exclude = left_out;
  return diagnose_gap(model, logs, options).verdict;
}

TEST(LeftOut, ACauseThatStandsInForItIsNotNamed) {
  Vehicle truth = published_vehicle();
  const Vehicle model = truth;
  truth.parameters["payload.m"] = {0.04, {}};
  truth.parameters["payload.x"] = {0.05, {}}, truth.parameters["payload.z"] = {0.03, {}};
  const Judged verdict = without({"payload"}, model, flight_of(truth, 5));
  EXPECT_TRUE(verdict.effects.empty()) << verdict.sentence;
  EXPECT_EQ(verdict.status, "unknown") << verdict.sentence;
}

TEST(LeftOut, ACauseThatNoneOfThemCouldBeIsNamed) {
  Vehicle truth = published_vehicle();
  const Vehicle model = truth;
  truth.parameters["rotor_drag.kd"] = {3e-5, {}};
  const Judged verdict = without({"ground_effect", "battery_sag", "cg_offset"}, model, flight_of(truth, 6));
  EXPECT_EQ(verdict.effects, std::vector<std::string>{"rotor_drag"}) << verdict.sentence;
}

TEST(LeftOut, OfAPayloadAndAShiftTooLightToTellEitherMayBeIt) {
  Vehicle truth = published_vehicle();
  const Vehicle model = truth;
  truth.parameters["cg_offset.x"] = {0.004, {}};
  const Judged verdict = without({"cg_offset"}, model, flight_of(truth, 6));
  EXPECT_TRUE(verdict.effects.empty()) << verdict.sentence;
}

}  // namespace
}  // namespace ident
