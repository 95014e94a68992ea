// A moment that stays is told from gusts, and in terms of where the weight would be.
#include "ident/flight/checks/mean_moment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
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
    EXPECT_NEAR(before(w->message, x > 0 ? " mm further ahead" : " mm further back"), 4, 0.4) << w->message;
    EXPECT_NEAR(before(w->message, " mm further left"), 3, 0.3) << w->message;
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

// Products of inertia do not make another axis of it, nor does a payload that is stated change the lever.
TEST(SteadyTurn, IsAMomentOfTheVehicleAsStated) {
  Vehicle truth = quad();
  truth.parameters["Jxy"] = {1.5e-4, {}};
  truth.parameters["payload.m"] = {0.05, {}}, truth.parameters["payload.z"] = {0.02, {}};
  const Vehicle stated = known(truth);
  truth.parameters["cg_offset.x"] = {0.004, {}};
  const FlightLog log = flight(truth, 250, 1, 30);
  const Result result = refine_flight(stated, std::span(&log, 1), kNumbers);
  const Warning* w = warning_of(result);
  ASSERT_NE(w, nullptr);
  EXPECT_NEAR(before(w->message, " mm further ahead"), 4, 0.4) << w->message;
  for (const char* other : {"further right", "further left", "about x", "about z", "one way"})
    EXPECT_EQ(w->message.find(other), std::string::npos) << w->message;
}

// Rotors that lean all one way about the vehicle turn it, and nothing is said of its weight.
TEST(SteadyTurn, YawIsToldInTorque) {
  Vehicle truth = quad();
  const double lean = 0.3 * truth.value("kQ") / truth.value("kT") / 0.1;
  for (Rotor& r : truth.rotors) r.a_B = Eigen::Vector3d(-lean * r.r_B[1], lean * r.r_B[0], -0.1).normalized();
  FlightLog log = flight(truth, 250, 1, 30);
  const Result result = refine_flight(known(quad()), std::span(&log, 1), kNumbers);
  const Warning* w = warning_of(result);
  ASSERT_NE(w, nullptr);
  EXPECT_NE(w->message.find("one way"), std::string::npos) << w->message;
  EXPECT_EQ(w->message.find("centre of gravity"), std::string::npos) << w->message;
}

// Of a mean moment of a few gusts, or of a few seconds, nothing is known.
TEST(SteadyTurn, GustsAndShortFlightsAreNotTaken) {
  SimulationOptions gusts;
  gusts.turbulence = 1.5, gusts.gust_arm = 0.03, gusts.duration = 24;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    gusts.seed = seed;
    const FlightLog log = simulate_flight(quad(), gusts).log;
    EXPECT_EQ(warning_of(refine_flight(known(quad()), std::span(&log, 1), kNumbers)), nullptr) << seed;
  }
  Vehicle truth = quad();
  truth.parameters["cg_offset.x"] = {0.004, {}};
  const FlightLog brief = flight(truth, 250, 1, 12);
  EXPECT_EQ(warning_of(refine_flight(known(quad()), std::span(&brief, 1), kNumbers)), nullptr);
}

// Where the frame is wrong no place is named.
TEST(SteadyTurn, OfWrongFramesNothingIsSaid) {
  Vehicle truth = quad();
  truth.parameters["cg_offset.x"] = {0.004, {}};
  FlightLog log = flight(truth, 250, 1, 30);
  for (double& q : log.w_B[1]) q = -q;
  const Result result = refine_flight(known(quad()), std::span(&log, 1), kNumbers);
  EXPECT_TRUE(result.has_warning("sign_flipped"));
  EXPECT_EQ(warning_of(result), nullptr);
}

TEST(SteadyTurn, NothingIsSaidOfAVehicleThatIsAsStated) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const FlightLog log = flight(quad(), 250, seed, 30);
    EXPECT_EQ(warning_of(refine_flight(known(quad()), std::span(&log, 1), kNumbers)), nullptr);
  }
}

}  // namespace
}  // namespace ident
