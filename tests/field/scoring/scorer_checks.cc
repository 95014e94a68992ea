// The scorer's own checks: reading logs, prediction by the true constants, the paired bootstrap, shares of
// causes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "../field_case.h"
#include "paired_bootstrap.h"
#include "predict.h"

namespace field {
namespace {

namespace fs = std::filesystem;

double rms(const std::vector<double>& squares) {
  double sum = 0;
  for (const double s : squares) sum += s;
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

Case a_still_case() {  // nothing but what the file states, good sensors, every command
  Case c = draw_case(11, 0, "plain");
  c.instruments.command_every = c.instruments.attitude_every = c.instruments.position_every = 1;
  c.instruments.gyro_order = c.instruments.accel_order = 0;
  c.instruments.imu_delay = 0;
  c.instruments.gyro_noise = c.instruments.velocity_noise = c.instruments.attitude_noise = 1e-4;
  c.instruments.velocity_drift = c.instruments.attitude_drift = 0;
  c.instruments.voltage = true;
  c.instruments.log_hz = 500;
  for (auto& s : c.settings) s.duration = 20, s.gust_share = 0;
  return c;
}

StatedModel truth_of(const Case& c, StatedModel model) {
  model.m = c.v.m;
  model.battery_voltage = c.v.battery.reference;
  model.constants = {{"kT", c.v.kT},
                     {"kQ", c.v.kQ},
                     {"km", c.v.km},
                     {"Omega_0", c.v.Omega_0},
                     {"Jp", c.v.Jp},
                     {"Jxx", c.v.J.x()},
                     {"Jyy", c.v.J.y()},
                     {"Jzz", c.v.J.z()},
                     {"dead_time", c.v.latency},
                     {"zeta_m", 50},
                     {"omega_m", 100 / c.v.lag()},
                     {"rotor_drag.kd", c.e.kd}};
  if (c.e.sag_exponent > 0) model.constants["battery_sag.n"] = c.e.sag_exponent;
  return model;
}

TEST(FieldPrediction, TrueConstantsPredictAPlainFlightAndStatedOnesDoNot) {
  Case c = a_still_case();
  fly_case(c);
  const fs::path folder = fs::temp_directory_path() / "field_prediction_check";
  write_case(c, folder.string());
  const StatedModel stated = read_model((folder / "cases" / "0000" / "vehicle.yaml").string());
  const Columns log = read_csv((folder / "held" / "0000" / "log3.csv").string());
  const PredictionErrors best = predict(truth_of(c, stated), log, RotorInput::kCommands);
  const PredictionErrors before = predict(stated, log, RotorInput::kCommands);
  EXPECT_LT(rms(best.velocity), 0.03);  // m/s
  EXPECT_LT(rms(best.rates), 0.05);     // rad/s
  EXPECT_GT(rms(before.velocity), 3 * rms(best.velocity));
  fs::remove_all(folder);
}

TEST(FieldLog, EmptyCellsAreNoSamplesAndHeldOnesCountOnce) {
  const fs::path path = fs::temp_directory_path() / "field_log_check.csv";
  std::ofstream(path) << "t,p,vx\n0,1,5\n0.1,,5\n0.2,3,6\n";
  const Columns log = read_csv(path.string());
  EXPECT_TRUE(std::isnan(log.at("p")[1]));
  EXPECT_EQ(samples_of(log, "p", false).x, (std::vector<double>{1, 3}));
  EXPECT_EQ(samples_of(log, "vx", true).t, (std::vector<double>{0, 0.2}));
  EXPECT_DOUBLE_EQ(samples_of(log, "p", false).interpolated(0.05), 1.5);
  EXPECT_DOUBLE_EQ(samples_of(log, "p", false).held(0.15), 1);
  fs::remove(path);
}

TEST(FieldBootstrap, TellsABetterPredictionFromOneThatIsBetterByChance) {
  Random random(1, 0, "windows");
  std::vector<double> first, same, better;
  for (int i = 0; i < 300; ++i) {
    const double x = random.normal(), y = random.normal();
    first.push_back(x * x);
    same.push_back(y * y);
    better.push_back(0.5 * x * x);
  }
  EXPECT_FALSE(compare(first, same, 30).second_better() || compare(first, same, 30).second_worse());
  EXPECT_TRUE(compare(first, better, 30).second_better());
  EXPECT_TRUE(compare(better, first, 30).second_worse());
  EXPECT_FALSE(compare(first, first, 30).second_worse());
}

TEST(FieldLedger, ASingleCauseClosesTheWholeGap) {
  Case c = draw_case(12, 1, "flexible_arms");
  for (auto& s : c.settings) s.duration = 6;
  fly_case(c);
  const Ledger& ledger = *c.flights[0].ledger;
  const auto alone = ledger.shares(c.instruments, {"rotor_drag"});
  ASSERT_TRUE(alone.contains("rotor_drag"));
  EXPECT_NEAR(alone.at("rotor_drag").forces, 1, 1e-9);
  const auto both = ledger.shares(c.instruments, {"rotor_drag", "flexible_arms"});
  EXPECT_LE(both.at("flexible_arms").all, 1);
}

}  // namespace
}  // namespace field
