// Thrust sweeps with one thing at a time that is as real stands make it.
#include "ident/bench/thrust/thrust_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ident/bench/columns/speed_column.h"
#include "ident/bench/thrust/thrust_sweep_fit.h"
#include "ident/bench/thrust/thrust_sweep_pool.h"
#include "ident/bench/thrust/thrust_sweep_rotor.h"
#include "ident/core/error.h"
#include "support/thrust_tables.h"

namespace ident {
namespace {

using bench::drop_column;
using bench::staircase_table;
using bench::SweepTable;
using bench::values;

TEST(ThrustSweep, FindsConstantsAndTares) {
  const Result result = estimate_thrust({SweepTable().table()});
  for (const auto& [name, truth] : {std::pair{"kT", 6e-6}, std::pair{"kQ", 9e-8}}) {
    const Parameter& p = *result.find(name);
    EXPECT_NEAR(p.value, truth, 4 * p.std) << name;
    EXPECT_LT(p.std, 0.01 * truth) << name;
    EXPECT_TRUE(p.identifiable);
  }
  EXPECT_NEAR(result.extra["sweeps"][0]["thrust_tare"]["value"].get<double>(), 0.1, 0.05);
  EXPECT_TRUE(result.has_warning("tare_offset"));
  EXPECT_FALSE(result.has_warning("quadratic_law_misfit"));
  EXPECT_GT(result.fit["r2"].get<double>(), 0.999);
}

TEST(ThrustSweep, ReversedSignsAreTurnedRoundAndNamed) {
  NumberTable table = SweepTable().table();
  for (const char* column : {"thrust", "torque"})
    for (double& v : values(table, column)) v = -v;
  const Result result = estimate_thrust({table});
  EXPECT_TRUE(result.has_warning("reversed_thrust"));
  EXPECT_TRUE(result.has_warning("reversed_torque"));
  EXPECT_NEAR(result.find("kT")->value / 6e-6, 1.0, 0.02);
  EXPECT_NEAR(result.find("kQ")->value / 9e-8, 1.0, 0.02);
}

TEST(ThrustSweep, ThrustAndTorqueMayStandInDifferentRows) {
  NumberTable table = SweepTable().table();
  for (std::size_t i = 0; i < table.rows(); ++i) values(table, i % 2 ? "thrust" : "torque")[i] = kNaN;
  const Result result = estimate_thrust({table});
  EXPECT_TRUE(result.has_warning("separate_rows"));
  EXPECT_NEAR(result.find("kT")->value / 6e-6, 1.0, 0.02);
  EXPECT_NEAR(result.find("kQ")->value / 9e-8, 1.0, 0.02);
}

TEST(ThrustSweep, AWrongPoleCountIsNamedAndTheOpticalSpeedUsed) {
  NumberTable table = SweepTable().table();
  table.columns[0].name = table.columns[0].header = "omega_optical";
  Column electrical = table.columns[0];
  electrical.name = electrical.header = "omega_electrical";
  for (double& v : electrical.values) v *= 7.0 / 6.0;
  table.columns.push_back(electrical);
  const Result result = estimate_thrust({table});
  ASSERT_TRUE(result.has_warning("pole_count"));
  for (const Warning& w : result.warnings)
    if (w.code == "pole_count") {
      EXPECT_NE(w.message.find("7/6"), std::string::npos) << w.message;
      EXPECT_NE(w.message.find("0.735"), std::string::npos) << w.message;  // (6/7)^2
    }
  EXPECT_NEAR(result.find("kT")->value / 6e-6, 1.0, 0.02);
}

TEST(ThrustSweep, SmallRatiosAreFoundAndOthersAreNot) {
  EXPECT_EQ(small_ratio(7.003, 14, 0.015).p, 7);
  EXPECT_EQ(small_ratio(0.5, 14, 0.015).q, 2);
  EXPECT_EQ(small_ratio(1.1667, 14, 0.015).p, 7);
  EXPECT_EQ(small_ratio(20.3, 14, 0.015).p, 0);
}

TEST(ThrustSweep, WithoutASpeedItSaysWhatIsMissing) {
  NumberTable table = SweepTable().table();
  table.columns[0].name = "omega_optical";
  table.columns[0].header = "Motor Optical Speed (RPM)";
  for (double& v : table.columns[0].values) v = 0.0;
  try {
    estimate_thrust({table});
    FAIL();
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("'Motor Optical Speed (RPM)' is zero throughout"),
              std::string::npos)
        << error.what();
  }
}

TEST(ThrustSweep, AFileThatCannotBeUsedIsLeftOutWhereThereAreOthers) {
  NumberTable bad = SweepTable().table();
  for (double& v : values(bad, "omega")) v = 0.0;
  const Result result = estimate_thrust({SweepTable().table(), bad});
  EXPECT_TRUE(result.has_warning("file_refused"));
  EXPECT_EQ(result.extra["sweeps"].size(), 1u);
}

TEST(ThrustSweep, ASingleRowWithoutSpeedButWithThrustIsNotTakenForRest) {
  SweepTable sweep;
  sweep.at_rest = 0;
  NumberTable table = sweep.table();
  values(table, "omega")[0] = 0.0;  // the first set-point turned, unseen
  drop_column(table, "delta");
  const Result result = estimate_thrust({table});
  EXPECT_TRUE(result.has_warning("rows_at_rest"));
  EXPECT_NEAR(result.find("kT")->value / 6e-6, 1.0, 0.02);
}

TEST(ThrustSweep, AScatterOfTheSpeedThatDrivesTheForcesIsToldFromNoise) {
  SweepTable noisy, wandering;
  noisy.speed_noise = wandering.speed_wander = 15.0;
  noisy.noise = wandering.noise = 0.004;
  const auto share = [](const SweepTable& sweep) {
    return estimate_thrust({sweep.table()}).extra["sweeps"][0]["speed"]["share_that_is_real"].get<double>();
  };
  EXPECT_NEAR(share(noisy), 0.0, 0.1);
  EXPECT_NEAR(share(wandering), 1.0, 0.1);
}

// LIBRARIES: noise in the rotor speed makes a plain fit find kT too small. 50 rad/s here: -4 sigma^2
// mean/var.
TEST(ThrustSweep, NoiseOfTheSpeedDoesNotBiasTheConstant) {
  std::vector<double> found;
  double predicted = 0.0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SweepTable sweep;
    sweep.seed = seed;
    sweep.speed_noise = 50.0;
    sweep.noise = 0.002;
    found.push_back(estimate_thrust({sweep.table()}).find("kT")->value / 6e-6 - 1.0);
    std::vector<Warning> unread;
    predicted = speed_noise_bias(sweep_points(sweep_rows(sweep.table(), {}, unread)).thrust, 50.0);
  }
  double sum = 0.0, square = 0.0;
  for (const double v : found) sum += v, square += v * v;
  const double mean = sum / 40, std = std::sqrt((square / 40 - mean * mean) / 40);
  EXPECT_LT(predicted, -0.01);
  EXPECT_LT(std::fabs(mean), 4 * std);
  EXPECT_LT(4 * std, -predicted);  // the test would see the bias
}

TEST(ThrustSweep, WithoutRepeatedRowsTheEffectOfSpeedNoiseIsNamed) {
  SweepTable sweep;
  sweep.repeats = 1;
  sweep.set_points = 20;
  EXPECT_TRUE(estimate_thrust({sweep.table()}).has_warning("speed_noise_unknown"));
}

TEST(ThrustSweep, ALawWithALinearTermIsToldFromAQuadraticOne) {
  SweepTable sweep;
  sweep.linear_term = 2e-3;  // N s/rad: at full speed 2 N of 8 N
  const Result result = estimate_thrust({sweep.table()});
  EXPECT_TRUE(result.has_warning("quadratic_law_misfit"));
  const auto& law = result.extra["quadratic_law"];
  EXPECT_GT(law["misfit_percent_fs"].get<double>(), 2.0);
  EXPECT_LT(law["with_linear_term_percent_fs"].get<double>(), 0.5);
  EXPECT_LT(law["p_value"].get<double>(), 1e-6);
}

// 100 sweeps that follow the law, in white and in strongly coloured noise: p below 5 % in 5 % of them, 4
// standard errors are 9 %.
TEST(ThrustSweep, ATrueQuadraticLawIsNotAccused) {
  for (const double rho : {0.0, 0.9}) {
    int accused = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
      SweepTable sweep;
      sweep.seed = seed;
      sweep.rho = rho;
      sweep.repeats = 3;
      drop_column(sweep.made(), "torque");
      accused += estimate_thrust({sweep.made()}).extra["quadratic_law"]["p_value"].get<double>() < 0.05;
    }
    EXPECT_LT(accused, rho > 0 ? 18 : 13) << rho;
  }
}

TEST(ThrustSweep, CoefficientsAreThoseOfTheirEquations) {
  const double R = 0.1, rho = 1.2, A = M_PI * 0.01;
  ThrustOptions options{.radius = R, .rho = rho};
  const Result result = estimate_thrust({SweepTable().table()}, options);
  const double kT = result.find("kT")->value, kQ = result.find("kQ")->value;
  EXPECT_NEAR(result.find("CT")->value, kT / (rho * A * R * R), 1e-12);
  EXPECT_NEAR(result.find("CQ")->value, kQ / (rho * A * R * R * R), 1e-12);
  // T^1.5/sqrt(2 rho A) over Q Omega at any speed, here 500 rad/s
  const double T = kT * 250000, Q = kQ * 250000;
  EXPECT_NEAR(result.find("figure_of_merit")->value, std::pow(T, 1.5) / std::sqrt(2 * rho * A) / (Q * 500),
              1e-12);
}

TEST(ThrustSweep, CommandCurveNeedsToKnowThePulseWidths) {
  SweepTable sweep;
  NumberTable table = sweep.table();
  for (Column& c : table.columns)
    if (c.name == "delta") {
      c.name = c.header = "u";
      for (double& v : c.values) v = 1100 + 840 * v;
    }
  const Result without = estimate_thrust({table});
  EXPECT_TRUE(without.has_warning("command_range_unknown"));
  EXPECT_EQ(without.find("km"), nullptr);
  const Result with = estimate_thrust({table}, {.command = CommandRange{1100, 1940}});
  ASSERT_NE(with.find("km"), nullptr);
  EXPECT_NEAR(with.find("km")->value, 1000, 10);
  EXPECT_NEAR(with.find("Omega_0")->value, 150, 10);
  EXPECT_TRUE(with.find("Omega_0")->identifiable);
}

TEST(ThrustSweep, FilesThatAgreeArePooledByPrecision) {
  const PooledEstimate pooled = pool({{1.00, 0.01, 20}, {1.02, 0.02, 20}});
  EXPECT_FALSE(pooled.files_differ);
  EXPECT_NEAR(pooled.value, 1.004, 2e-4);  // (1/0.01^2 + 1.02/0.02^2)/(1/0.01^2 + 1/0.02^2)
  EXPECT_NEAR(pooled.std, 1.0 / std::sqrt(1e4 + 2.5e3), 2e-4);
}

TEST(ThrustSweep, FilesThatDifferAreASampleOfFiles) {
  const PooledEstimate pooled =
      pool({{1.00, 0.001, 50}, {1.05, 0.001, 50}, {0.96, 0.001, 50}, {1.02, 0.001, 50}});
  EXPECT_TRUE(pooled.files_differ);
  EXPECT_NEAR(pooled.std, 0.0381 / 2, 2e-3);  // standard deviation of the logarithms over sqrt(4)
  EXPECT_EQ(pooled.dof, 3);
  EXPECT_NEAR(pooled.scatter, 0.0381, 2e-3);
}

TEST(ThrustLog, OnlySteadyRowsOfAStaircaseCount) {
  const Result result = estimate_thrust({staircase_table({})});
  EXPECT_TRUE(result.has_warning("transients_excluded"));
  const Parameter& kT = *result.find("kT");
  EXPECT_NEAR(kT.value, 6e-6, 4 * kT.std);
  EXPECT_LT(kT.std, 0.005 * kT.value);
}

TEST(ThrustLog, SpikesOfTheSpeedAreCounted) {
  NumberTable table = staircase_table({});
  for (const std::size_t i : {1200u, 1700u, 2100u}) values(table, "omega")[i] *= 0.5;
  const Result result = estimate_thrust({table});
  ASSERT_TRUE(result.has_warning("speed_spikes"));
  for (const Warning& w : result.warnings)
    if (w.code == "speed_spikes") {
      EXPECT_NE(w.message.find(" 3 readings"), std::string::npos) << w.message;
    }
  EXPECT_NEAR(result.find("kT")->value / 6e-6, 1.0, 0.01);
}

TEST(ThrustLog, ARampIsFittedThroughTheLagOfTheLoadCell) {
  const Result result = estimate_thrust({bench::ramp_table(0.3)});
  ASSERT_TRUE(result.has_warning("no_steady_rows"));
  EXPECT_NEAR(result.find("kT")->value / 6e-6, 1.0, 0.02);
  for (const Warning& w : result.warnings)
    if (w.code == "no_steady_rows") {
      EXPECT_NE(w.message.find("lag of 0.3 s"), std::string::npos) << w.message;
    }
}

TEST(ThrustLog, ADriftOfTheTareIsNamed) {
  const Result result = estimate_thrust({staircase_table({.drift = 0.5})});
  EXPECT_TRUE(result.has_warning("tare_drift"));
}

// Where every row may be the odd one, none is taken for an outlier: leaving out one after the other ends with
// a fit through what is left that nothing contradicts.
TEST(ThrustSweep, AFewRowsAreAllKept) {
  for (int rows = 3; rows <= 8; ++rows) {
    NumberTable table = SweepTable().table();
    drop_column(table, "torque");
    table.line.resize(static_cast<std::size_t>(rows));
    for (Column& column : table.columns) column.values.resize(static_cast<std::size_t>(rows));
    for (int i = 0; i < rows; ++i) {
      const auto row = static_cast<std::size_t>(i);
      values(table, "omega")[row] = 100.0 * (i + 1);
      values(table, "thrust")[row] = 6e-2 * (i + 1) * (i + 1) + (i % 3 - 1) * 0.01;
    }
    const Result result = estimate_thrust({table});
    EXPECT_NEAR(result.find("kT")->value, 6e-6, 0.5e-6) << rows;
    EXPECT_GT(result.find("kT")->std, 0) << rows;
  }
}

}  // namespace
}  // namespace ident
