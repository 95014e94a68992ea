// What a refinement says of thrust as a whole: its curve over the commands, and whether it carries the
// weight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using testing::flight;
using testing::known;
using testing::quad;

const RefineOptions kNumbers{.validate = false};

TEST(ThrustOverCommands, IsKnownWhereItsConstantsAreKnownOnlyTogether) {
  for (const double offset : {0.0, 150.0}) {
    Vehicle truth = quad();
    truth.parameters["Omega_0"] = {offset, {}};
    FlightLog log = flight(truth, 250, 1);
    log.Omega.clear();
    Vehicle stated = known(truth);
    stated.parameters["Omega_0"].std = 0.2 * offset + 1e-3;
    const Result result = refine_flight(stated, std::span(&log, 1), kNumbers);
    ASSERT_TRUE(result.fit.contains("thrust_by_command"));
    const auto& curve = result.fit["thrust_by_command"];
    ASSERT_EQ(curve.size(), 7u);
    const Parameter& kT = *result.find("kT");
    for (const auto& point : curve) {
      const double u = point["command"], T = point["thrust"], deviation = point["std"];
      const double right = truth.value("kT") * std::pow(offset + truth.value("km") * u, 2);
      EXPECT_NEAR(T, right, 4 * deviation) << u;
      EXPECT_GT(deviation, 1e-5 * T);
      EXPECT_LT(deviation / T, 0.3 * kT.std / kT.value) << u;
    }
    EXPECT_LT(curve.front()["command"].get<double>(), curve.back()["command"].get<double>());
  }
}

TEST(ThrustOverCommands, AsksForCommands) {
  const Vehicle truth = quad();
  FlightLog log = flight(truth, 250, 1);
  log.delta.clear();
  const Result result = refine_flight(known(truth), std::span(&log, 1), kNumbers);
  EXPECT_FALSE(result.fit.contains("thrust_by_command"));
}

// Nothing but gusts can make up for a thrust constant that is held where it is wrong.
TEST(SteadyPush, ThrustThatDoesNotCarryTheWeightIsNamed) {
  const Vehicle truth = quad();
  const FlightLog log = flight(truth, 250, 2);
  for (const double factor : {1.0, 0.85, 1.12}) {
    Vehicle stated = known(truth);
    for (const char* name : {"kT", "km", "m"}) stated.parameters[name].std = 1e-6 * truth.value(name);
    stated.parameters["Omega_0"] = {0.0, {}}, stated.parameters["kT"].value *= factor;
    const Result result = refine_flight(stated, std::span(&log, 1), kNumbers);
    const auto w = std::ranges::find(result.warnings, "thrust_level", &Warning::code);
    ASSERT_EQ(w != result.warnings.end(), factor != 1.0) << factor;
    EXPECT_EQ(result.find("Jxx")->identifiable, factor == 1.0);  // moments are known by what thrust does
    EXPECT_EQ(result.fit.contains("thrust_by_command"), factor == 1.0);
    if (factor == 1.0) continue;
    const std::string by = factor < 1 ? "15 % less" : "12 % more";
    EXPECT_NE(w->message.find(by), std::string::npos) << w->message;
  }
}

// A full battery and an empty one: in the mean of both thrust is right.
TEST(SteadyPush, LogsOfDifferentThrustAreNamed) {
  const Vehicle truth = quad();
  for (const double apart : {0.0, 0.04}) {
    std::vector<FlightLog> logs;
    for (const int i : {0, 1}) {
      Vehicle flown = truth;
      flown.parameters["kT"].value *= 1 + (i == 0 ? apart : -apart);
      logs.push_back(flight(flown, 250, 2 + static_cast<std::uint64_t>(i)));
      logs.back().file = i == 0 ? "full.csv" : "empty.csv";
    }
    const Result result = refine_flight(known(truth), logs, kNumbers);
    const auto w = std::ranges::find(result.warnings, "thrust_level", &Warning::code);
    ASSERT_EQ(w != result.warnings.end(), apart > 0) << apart;
    EXPECT_EQ(result.find("kT")->identifiable, apart == 0);
    if (apart > 0) {
      EXPECT_NE(w->message.find(".csv"), std::string::npos) << w->message;
    }
  }
}

// What leans against a wind is held down by nothing.
TEST(SteadyPush, DragOfALeaningVehicleIsNotAThrustError) {
  Vehicle truth = quad();
  const Vehicle stated = known(truth);
  truth.parameters["wind.north"] = {6.0, {}}, truth.parameters["parasitic_drag.C"] = {0.02, {}};
  SimulationOptions options;
  options.seed = 3, options.duration = 30, options.turbulence = 0.2;
  const FlightLog log = simulate_flight(truth, options).log;
  double lean = 0;  // mean cosine of the tilt
  for (std::size_t i = 0; i < log.rows(); ++i)
    lean += (1 - 2 * (std::pow(log.q_WB[1][i], 2) + std::pow(log.q_WB[2][i], 2))) /
            static_cast<double>(log.rows());
  ASSERT_LT(lean, std::cos(0.2));
  const Result result = refine_flight(stated, std::span(&log, 1), kNumbers);
  EXPECT_FALSE(result.has_warning("thrust_level"));
  EXPECT_FALSE(result.has_warning("command_offset"));
}

}  // namespace
}  // namespace ident
