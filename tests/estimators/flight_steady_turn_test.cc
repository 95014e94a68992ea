// A moment that stays is told from gusts, and in terms of where the weight would be.
#include "ident/estimators/flight_steady_turn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "ident/estimators/flight_refine.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using testing::flight;
using testing::known;
using testing::quad;

const RefineOptions kNumbers{.validate = false};

const Warning* warning_of(const Result& result) {
  const auto w = std::ranges::find(result.warnings, "steady_moment", &Warning::code);
  return w == result.warnings.end() ? nullptr : &*w;
}

// The number before a word.
double before(const std::string& text, const std::string& word) {
  const std::size_t end = text.find(word);
  if (end == std::string::npos) return kNaN;
  return std::strtod(text.c_str() + text.rfind(' ', end - 1) + 1, nullptr);
}

TEST(SteadyTurn, CentreOfGravityIsWhereItIsSaidToBe) {
  for (const double x : {0.004, -0.004}) {
    Vehicle truth = quad();
    truth.parameters["cg_offset.x"] = {x, {}}, truth.parameters["cg_offset.y"] = {-0.003, {}};
    const FlightLog log = flight(truth, 250, 1, 30);
    Vehicle stated = known(truth);
    stated.parameters.erase("cg_offset.x"), stated.parameters.erase("cg_offset.y");
    const Result result = refine_flight(stated, std::span(&log, 1), kNumbers);
    const Warning* w = warning_of(result);
    ASSERT_NE(w, nullptr);
    EXPECT_NEAR(before(w->message, x > 0 ? " mm ahead" : " mm behind"), 4, 0.4) << w->message;
    EXPECT_NEAR(before(w->message, " mm left"), 3, 0.3) << w->message;
  }
}

TEST(SteadyTurn, IsNamedOfTheLogThatHasIt) {
  std::vector<FlightLog> logs;
  for (const double x : {0.0, 0.005}) {
    Vehicle flown = quad();
    if (x > 0) flown.parameters["cg_offset.x"] = {x, {}};
    logs.push_back(flight(flown, 250, x > 0 ? 3 : 2, 30));
    logs.back().file = x > 0 ? "loaded.csv" : "empty.csv";
  }
  const Result result = refine_flight(known(quad()), logs, kNumbers);
  const Warning* w = warning_of(result);
  ASSERT_NE(w, nullptr);
  EXPECT_NE(w->message.find("loaded.csv"), std::string::npos) << w->message;
}

TEST(SteadyTurn, NothingIsSaidOfAVehicleThatIsAsStated) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const FlightLog log = flight(quad(), 250, seed, 30);
    EXPECT_EQ(warning_of(refine_flight(known(quad()), std::span(&log, 1), kNumbers)), nullptr);
  }
}

}  // namespace
}  // namespace ident
