// PX4's allocation against commands that PX4 itself logged, and against its laws.
#include "ident/io/rebuild/px4_commands.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ident/io/log_formats/read_log_streams.h"
#include "ident/io/rebuild/px4_allocation.h"
#include "support/log_samples.h"

namespace ident {
namespace {

LogStreams quad_x() {
  LogStreams log{.file = "flight.ulg", .format = "ulog"};
  log.parameters["CA_ROTOR_COUNT"] = 4;
  const double x[] = {1, -1, 1, -1}, y[] = {1, -1, -1, 1}, spin[] = {1, 1, -1, -1};
  for (int n = 0; n < 4; ++n) {
    log.parameters[fmt::format("CA_ROTOR{}_PX", n)] = 0.2 * x[n];
    log.parameters[fmt::format("CA_ROTOR{}_PY", n)] = 0.2 * y[n];
    log.parameters[fmt::format("CA_ROTOR{}_KM", n)] = 0.05 * spin[n];
  }
  return log;
}

TEST(Px4Allocation, OfASquareQuadrotorIsTheTextbookMixer) {
  // All entries of a column have one size. Roll: sqrt(4 k^2/2) = sqrt(2) k makes each 1/sqrt(2); yaw and
  // thrust: 1.
  const Eigen::MatrixXd mix = px4_mix(quad_x()).value();
  const double r = std::sqrt(0.5);
  Eigen::MatrixXd expected(4, 6);
  expected << -r, r, 1, 0, 0, -1,  // front right, turns counter-clockwise
      r, -r, 1, 0, 0, -1,          // rear left
      r, r, -1, 0, 0, -1,          // front left
      -r, -r, -1, 0, 0, -1;        // rear right
  EXPECT_LT((mix - expected).cwiseAbs().maxCoeff(), 1e-12) << mix;
}

TEST(Px4Allocation, ThrustCurveIsInverted) {
  for (const double f : {0.2, 0.7, 1.0})
    for (const double thrust : {0.0, 0.1, 0.5, 1.0}) {
      const double u = px4_command(thrust, f);
      EXPECT_NEAR((1 - f) * u + f * u * u, thrust, 1e-14);
    }
  EXPECT_EQ(px4_command(0.3, 0.0), 0.3);
}

TEST(Px4Commands, OfARealLogAreRebuiltToTheRoundingOfAFloat) {
  IDENT_NEEDS_LOG_SAMPLE(path, "ulog/pyulog__sample_px4_events.ulg");
  LogStreams log = read_log_streams(path);
  add_px4_commands(log);
  const LogStream* rebuilt = log.find("motor_commands");
  const LogStream* logged = log.find("actuator_motors:0");
  ASSERT_NE(rebuilt, nullptr);
  EXPECT_EQ(rebuilt->fields.size(), 4U);
  EXPECT_NE(log.facts["commands"].find("commands rebuilt"), std::string::npos) << log.facts["commands"];
  EXPECT_GT(rebuilt->t.size(), 2 * logged->t.size());  // 50 Hz in flight against 10 Hz
  for (std::size_t i = 1; i < rebuilt->t.size(); ++i) ASSERT_GT(rebuilt->t[i], rebuilt->t[i - 1]);
}

TEST(Px4Commands, AreNotRebuiltWhereTheParametersContradictTheMotors) {
  IDENT_NEEDS_LOG_SAMPLE(path, "ulog/pyulog__sample_px4_events.ulg");
  LogStreams log = read_log_streams(path);
  log.parameters["CA_ROTOR0_PX"] = 0.3;
  add_px4_commands(log);
  EXPECT_NE(log.facts["commands"].find("more than 1e-3"), std::string::npos) << log.facts["commands"];
  EXPECT_EQ(log.find("motor_commands")->t.size(), log.find("actuator_motors:0")->t.size());
}

}  // namespace
}  // namespace ident
