// Measured rotor speeds as the input of a diagnosis: what depends on their smoothing is no cause.
#include "ident/gap/verdict/input_smoothing.h"

#include <gtest/gtest.h>

#include "ident/core/random.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/flight/make_record.h"
#include "support/diagnosed.h"

namespace ident {
namespace {

// A model with a wrong Jxx, stated 1 and found to be 1.4 with a deviation of 0.02, and rotor drag of 3e-5
// with one of 1e-6.
FittedModel model_with(const std::string& cause) {
  FittedModel model;
  FreeConstant Jxx{.name = "Jxx", .index = find_parameter("Jxx")->index, .start = 1.0};
  Jxx.prior_value = 1.0;
  const FreeConstant drag{
      .name = "rotor_drag.kd", .index = find_parameter("rotor_drag.kd")->index, .scale = 1e-5};
  model.constants = {Jxx, drag};
  Candidate found{.name = cause};
  if (cause == "parameter:Jxx") found.parameter = 0;
  model.adopted = {found};
  model.theta =
      std::make_shared<Theta>(parameter_vector(testing::published_vehicle()), model.constants, 1, false);
  model.fit.u = Eigen::Vector2d(0.4, 3.0);
  model.fit.covariance = Eigen::Vector2d(0.02 * 0.02, 0.1 * 0.1).asDiagonal();
  return model;
}

using Names = std::vector<std::string>;

TEST(InputSmoothing, ACauseWhoseSizeMovesIsTold) {
  const FittedModel inertia = model_with("parameter:Jxx"), drag = model_with("rotor_drag");
  EXPECT_EQ(depend_on_smoothing(inertia, Eigen::Vector2d(-0.2, 0.0)), Names{"parameter:Jxx"});
  EXPECT_EQ(depend_on_smoothing(inertia, Eigen::Vector2d(0.2, 0.0)), Names{"parameter:Jxx"});
  EXPECT_EQ(depend_on_smoothing(drag, Eigen::Vector2d(0.0, 1.0)), Names{"rotor_drag"});
}

TEST(InputSmoothing, OneThatMovesByAFewPerCentOrWithinItsDeviationIsNot) {
  const FittedModel inertia = model_with("parameter:Jxx"), drag = model_with("rotor_drag");
  EXPECT_TRUE(depend_on_smoothing(inertia, Eigen::Vector2d(0.05, 0.0)).empty());
  EXPECT_TRUE(depend_on_smoothing(inertia, Eigen::Vector2d(0.0, 3.0)).empty());  // not of this cause
  FittedModel weak = model_with("rotor_drag");
  weak.fit.u[1] = 0.2;  // two deviations, of which half one is more than a quarter
  EXPECT_TRUE(depend_on_smoothing(weak, Eigen::Vector2d(0.0, 0.09)).empty());
  EXPECT_EQ(depend_on_smoothing(weak, Eigen::Vector2d(0.0, 0.15)), Names{"rotor_drag"});
}

// A payload's place is the ratio of two unknowns: where both move alike it stays.
TEST(InputSmoothing, APlaceThatIsAProductMovesAsThePlaceDoes) {
  FittedModel model;
  FreeConstant mass{.name = "payload.m", .index = find_parameter("payload.m")->index, .positive = true};
  FreeConstant place{.name = "payload.x", .index = find_parameter("payload.x")->index};
  mass.start = 0.03, place.start = 0.05, place.scale = 0.05, place.times = mass.index;
  model.constants = {mass, place};
  model.adopted = {{.name = "payload"}};
  model.theta =
      std::make_shared<Theta>(parameter_vector(testing::published_vehicle()), model.constants, 1, false);
  model.fit.u = Eigen::Vector2d(0.0, 0.0);
  model.fit.covariance = Eigen::Vector2d(1.0, 0.01).asDiagonal();  // mass hardly known, its moment well
  const double by = 0.5;
  EXPECT_TRUE(depend_on_smoothing(model, Eigen::Vector2d(by, std::exp(by) - 1)).empty());
}

TEST(InputSmoothing, AVerdictWithALooseCauseIsWithdrawnAndKeepsItsRivals) {
  Judged verdict{.status = "ambiguous", .effects = {"wind"}, .confused_with = {"payload"}};
  GapClosed gap;
  gap.before = 3, gap.after = 1;
  const Judged kept =
      with_noisy_input(verdict, {"rotor_drag"}, {}, gap, kNaN);  // which only carries the wind
  EXPECT_EQ(kept.status, "ambiguous");
  EXPECT_EQ(kept.effects, Names{"wind"});
  const Judged withdrawn = with_noisy_input(verdict, {"rotor_drag", "wind"}, {}, gap, kNaN);
  EXPECT_EQ(withdrawn.status, "unknown");
  EXPECT_TRUE(withdrawn.effects.empty());
  EXPECT_EQ(withdrawn.confused_with, (Names{"wind", "payload"}));
  EXPECT_NE(withdrawn.sentence.find("the size depends"), std::string::npos);
  EXPECT_NE(withdrawn.sentence.find("log the commands too"), std::string::npos);
  gap.after = 3.1;
  EXPECT_EQ(with_noisy_input(verdict, {}, {}, gap, kNaN).status, "unknown");
}

TEST(InputSmoothing, WhatIsTooSmallToBeSeenIsNotNamedWhereTheRestIsNoise) {
  const Judged verdict{.status = "identified", .effects = {"gyroscopic"}};
  GapClosed gap;
  gap.before = 3, gap.after = 1.02, gap.floor = 1;
  const Judged none = with_noisy_input(verdict, {}, {"gyroscopic"}, gap, 1.05);
  EXPECT_EQ(none.status, "none");
  EXPECT_TRUE(none.effects.empty());
  EXPECT_EQ(with_noisy_input(verdict, {}, {"wind"}, gap, 1.05).effects, Names{"gyroscopic"});
  EXPECT_EQ(with_noisy_input(verdict, {}, {"gyroscopic"}, gap, 1.5).effects, Names{"gyroscopic"})
      << "the constants alone leave more";
  EXPECT_EQ(with_noisy_input(verdict, {}, {}, gap, kNaN).effects, Names{"gyroscopic"});
}

// Rotors that are over with a change before three rows have passed, by a file that says so.
TEST(InputSmoothing, OfFastMotorsACauseHasToBeLarger) {
  Vehicle vehicle = testing::published_vehicle();
  const std::vector<FlightLog> logs{testing::flight_of(vehicle, 2)};
  const auto size = [&](double lag) {
    vehicle.parameters["omega_m"].value = 2 * vehicle.value("zeta_m") / lag;
    return least_size(make_flight_record(vehicle, parameter_vector(vehicle), logs));
  };
  const double row = logs[0].t[1] - logs[0].t[0];
  EXPECT_EQ(size(10 * row), 1.0);
  EXPECT_GT(size(1.5 * row), 1.0);
}

std::vector<FlightLog> without_commands(const Vehicle& truth, double noise) {
  std::vector<FlightLog> logs{testing::flight_of(truth, 2)};
  logs[0].delta.clear();
  Random random(7);
  for (auto& column : logs[0].Omega)
    for (double& Omega : column) Omega += noise * random.normal();
  return logs;
}

TEST(InputSmoothing, AnEffectIsNamedWithoutCommandsToo) {
  Vehicle truth = testing::published_vehicle();
  const Vehicle model = truth;
  truth.parameters["rotor_drag.kd"] = {3e-5, {}};
  const std::vector<FlightLog> logs = without_commands(truth, 1.0);
  EXPECT_EQ(diagnose_gap(model, logs).result.extra["verdict"]["effects"],
            nlohmann::ordered_json({"rotor_drag"}));
  GapOptions options;
  options.exclude = {"rotor_drag"};
  const auto v = diagnose_gap(model, logs, options).result.extra["verdict"];
  EXPECT_EQ(v["status"], "unknown") << v;
  EXPECT_NE(v["sentence"].get<std::string>().find("log the commands too"), std::string::npos) << v;
}

// Taken as they are, speeds with so much noise make the same flight a gap that is not there.
TEST(InputSmoothing, NoiseOfSpeedsIsNoGap) {
  const Vehicle truth = testing::published_vehicle();
  const auto v = diagnose_gap(truth, without_commands(truth, 1.0)).result.extra["verdict"];
  EXPECT_EQ(v["status"], "none") << v;
}

// What depends on the smoothing is in the deviations that a diagnosis states, the same ones everywhere.
TEST(InputSmoothing, ACauseHasOneDeviation) {
  Vehicle truth = testing::published_vehicle();
  const Vehicle model = truth;
  truth.parameters["rotor_drag.kd"] = {3e-5, {}};
  const Diagnosis found = diagnose_gap(model, without_commands(truth, 1.0));
  const Parameter* drag = found.result.find("rotor_drag.kd");
  ASSERT_NE(drag, nullptr);
  EXPECT_DOUBLE_EQ(drag->std, found.adopted.parameters.at("rotor_drag.kd").std.value());
  for (const auto& c : found.result.extra["candidates"]) {
    if (c["effect"] != "rotor_drag") continue;
    EXPECT_DOUBLE_EQ(drag->std, c["parameters"]["rotor_drag.kd"]["std"].get<double>());
  }
}

}  // namespace
}  // namespace ident
