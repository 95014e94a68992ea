// Measured rotor speeds as the input of a diagnosis: what depends on their smoothing is no cause.
#include "ident/gap/input_smoothing.h"

#include <gtest/gtest.h>

#include "ident/core/random.h"
#include "ident/effects/catalogue.h"
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

TEST(InputSmoothing, ACauseWhoseSizeMovesIsTold) {
  const FittedModel inertia = model_with("parameter:Jxx"), drag = model_with("rotor_drag");
  EXPECT_EQ(depends_on_smoothing(inertia, Eigen::Vector2d(-0.2, 0.0)), "parameter:Jxx");
  EXPECT_EQ(depends_on_smoothing(inertia, Eigen::Vector2d(0.2, 0.0)), "parameter:Jxx");
  EXPECT_EQ(depends_on_smoothing(drag, Eigen::Vector2d(0.0, 1.0)), "rotor_drag");
}

TEST(InputSmoothing, OneThatMovesByAFewPerCentOrWithinItsDeviationKeepsItsName) {
  const FittedModel inertia = model_with("parameter:Jxx"), drag = model_with("rotor_drag");
  EXPECT_EQ(depends_on_smoothing(inertia, Eigen::Vector2d(0.05, 0.0)), "");
  EXPECT_EQ(depends_on_smoothing(inertia, Eigen::Vector2d(0.0, 3.0)), "");  // not of this cause
  EXPECT_EQ(depends_on_smoothing(drag, Eigen::Vector2d(0.0, 0.09)), "");
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

TEST(InputSmoothing, NoiseOfSpeedsGetsNoName) {
  const Vehicle truth = testing::published_vehicle();
  for (const double noise : {0.5, 5.0}) {
    const auto v = diagnose_gap(truth, without_commands(truth, noise)).result.extra["verdict"];
    EXPECT_TRUE(v["effects"].empty()) << v;
  }
}

}  // namespace
}  // namespace ident
