// The motor estimator: exact responses and derivatives, all damping regimes, honest findings.
#include "ident/bench/motor/motor_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ident/bench/motor/motor_step_model.h"
#include "ident/core/error.h"
#include "ident/sim/simulate_bench.h"
#include "ident/sim/simulate_motor.h"
#include "support/bench_campaign.h"
#include "support/random_vehicle.h"

namespace ident {
namespace {

StepRecord irregular_record() {
  StepRecord record{.file = "steps.csv"};
  for (int i = 0; i < 60; ++i) record.t.push_back(0.01 * i + 0.003 * std::sin(7.0 * i));
  std::ranges::sort(record.t);
  record.Omega.assign(60, 0.0);
  record.edges = {{record.t[0], 0.2}, {record.t[10], 0.7}, {record.t[11] + 0.001, 0.4, true}, {0.3, 0.9}};
  return record;
}

Eigen::MatrixXd commands(const StepRecord& record) {
  Eigen::MatrixXd inputs(static_cast<Eigen::Index>(record.edges.size()), 2);
  for (std::size_t e = 0; e < record.edges.size(); ++e)
    inputs.row(static_cast<Eigen::Index>(e)) << record.edges[e].delta, 1.0;
  return inputs;
}

/// [Phang 22] by Runge-Kutta with steps of 10 us, the command looked up at each instant.
std::vector<double> integrated(const StepRecord& record, const MotorShape& shape) {
  const double h = 1e-5;
  const auto target = [&](double t) {
    double delta = record.edges.front().delta;
    for (const CommandEdge& edge : record.edges)
      if (edge.t + shape.dead_time <= t) delta = edge.delta;
    return delta;
  };
  const auto rate = [&](double t, double x, double v) {
    return shape.omega_m * shape.omega_m * (target(t) - x) - 2.0 * shape.zeta_m * shape.omega_m * v;
  };
  double t = record.t.front(), x = 0.0, v = 0.0;
  std::vector<double> result;
  for (const double at : record.t) {
    while (t < at - 1e-12) {
      const double s = std::min(h, at - t), m = t + s / 2;
      const double k1 = rate(m, x, v), k2 = rate(m, x + s / 2 * v, v + s / 2 * k1);
      const double k3 = rate(m, x + s / 2 * (v + s / 2 * k1), v + s / 2 * k2);
      const double k4 = rate(m, x + s * (v + s / 2 * k2), v + s * k3);
      x += s * v + s * s / 6 * (k1 + k2 + k3);
      v += s / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      t += s;
    }
    result.push_back(x);
  }
  return result;
}

TEST(MotorResponses, EqualTheIntegratedMotorForEdgesAnywhereAndAnyDamping) {
  const StepRecord record = irregular_record();
  for (const double zeta_m : {0.3, 1.0, 1.0001, 4.0}) {
    const MotorShape shape{.omega_m = 40.0, .zeta_m = zeta_m, .dead_time = 0.0137};
    const MotorResponses r = motor_responses(record, commands(record), shape, Slopes::no);
    const std::vector<double> expected = integrated(record, shape);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(r.value(static_cast<Eigen::Index>(i), 0), expected[i], 3e-4) << zeta_m << " at row " << i;
  }
}

TEST(MotorResponses, HaveTheDerivativesOfTheirDifferencesAlsoWhereEdgesFallOnSamples) {
  StepRecord record = irregular_record();
  for (const double dead_time : {0.0, 0.0137, -0.002}) {
    for (const double zeta_m : {0.5, 1.0, 3.0}) {
      const std::array<double, 4> at = {35.0, zeta_m, dead_time, 0.8};
      const auto responses = [&](const std::array<double, 4>& p, Slopes slopes) {
        return motor_responses(record, commands(record), {p[0], p[1], p[2], p[3]}, slopes);
      };
      const MotorResponses r = responses(at, Slopes::yes);
      for (std::size_t k = 0; k < 4; ++k) {
        const double e = k == 2 ? 1e-7 : 1e-6 * at[k];
        auto above = at, below = at;
        above[k] += e;
        below[k] -= e;
        const Eigen::MatrixXd difference =
            (responses(above, Slopes::no).value - responses(below, Slopes::no).value) / (2 * e);
        const double scale = difference.cwiseAbs().maxCoeff();
        EXPECT_LT((r.slope[k] - difference).cwiseAbs().maxCoeff(), 1e-4 * scale) << "parameter " << k;
      }
    }
  }
}

TEST(MotorResponses, DependOnlyOnOmegaForEdgesDown) {
  const StepRecord record = irregular_record();
  const MotorShape alike{.omega_m = 40.0, .zeta_m = 1.0, .dead_time = 0.0137}, slower{40.0, 1.0, 0.0137, 0.5};
  const MotorResponses a = motor_responses(record, commands(record), alike, Slopes::no);
  const MotorResponses b = motor_responses(record, commands(record), slower, Slopes::no);
  EXPECT_TRUE(a.value.topRows(11).isApprox(b.value.topRows(11)));
  EXPECT_FALSE(a.value.isApprox(b.value, 1e-3));
}

bench::BenchVehicle motor(double omega_m, double zeta_m) {
  bench::Random random(1);
  bench::BenchVehicle vehicle = bench::random_vehicle(random);
  vehicle.km = 1000.0;
  vehicle.omega_m = omega_m;
  vehicle.zeta_m = zeta_m;
  vehicle.dead_time = 0.012;
  return vehicle;
}

Result estimate(const bench::BenchVehicle& vehicle, bench::StepTest test, std::uint64_t seed = 2) {
  bench::Random random(seed);
  return estimate_motor({bench::motor_steps(vehicle, random, test).table});
}

void expect_holds(const Result& result, const char* name, double truth) {
  const Parameter& p = *result.find(name);
  // Five standard deviations: one false alarm in a million.
  EXPECT_NEAR(p.value, truth, 5.0 * p.std) << name;
}

TEST(Motor, FindsUnderdampedCriticalAndOverdampedMotors) {
  for (const double zeta_m : {0.4, 1.0, 1.8}) {
    const Result result = estimate(motor(25.0, zeta_m), {});
    expect_holds(result, "km", 1000.0);
    expect_holds(result, "omega_m", 25.0);
    expect_holds(result, "zeta_m", zeta_m);
    expect_holds(result, "dead_time", 0.012);
    EXPECT_TRUE(result.find("omega_m")->identifiable);
    EXPECT_FALSE(result.has_warning("not_separable"));
    EXPECT_FALSE(result.has_warning("spin_asymmetry"));
    EXPECT_EQ(result.find("Omega_0"), nullptr);
  }
}

TEST(Motor, SaysWhatIsKnownOfAMotorOfFirstOrder) {
  // A second pole 40 times as fast as the first: 2 zeta_m/omega_m = 50 ms.
  const Result result = estimate(motor(128.0, 3.2), {.noise = 5.0});
  ASSERT_TRUE(result.has_warning("not_separable"));
  EXPECT_FALSE(result.find("omega_m")->identifiable);
  EXPECT_FALSE(result.find("zeta_m")->identifiable);
  const auto& lag = result.extra["total_lag"];
  EXPECT_NEAR(lag["value"].get<double>(), 0.05 + 0.012, 5 * lag["std"].get<double>());
  EXPECT_LT(lag["std"].get<double>(), 0.003);
  EXPECT_EQ(result.extra["step_response"]["t"].size(), result.extra["step_response"]["std"].size());
}

TEST(Motor, ReportsAnOffsetWhereTheDataShowOne) {
  const Result result = estimate(motor(25.0, 0.8), {.Omega_0 = 80.0});
  ASSERT_NE(result.find("Omega_0"), nullptr);
  expect_holds(result, "Omega_0", 80.0);
  expect_holds(result, "km", 1000.0);
}

TEST(Motor, ACurvedStaticCharacteristicDoesNotReachTheDynamics) {
  const Result result = estimate(motor(25.0, 0.8), {.curvature = 0.3});
  EXPECT_TRUE(result.has_warning("static_curve"));
  expect_holds(result, "omega_m", 25.0);
  expect_holds(result, "zeta_m", 0.8);
  expect_holds(result, "dead_time", 0.012);
}

TEST(Motor, NoticesThatSpinDownIsSlower) {
  const Result result = estimate(motor(25.0, 0.8), {.down_ratio = 0.75});
  ASSERT_TRUE(result.has_warning("spin_asymmetry"));
  const auto& spin = result.extra["spin"];
  EXPECT_NEAR(spin["ratio"].get<double>(), 0.75, 5 * spin["std"].get<double>());
  EXPECT_GT(spin["time_constant_down"]["value"].get<double>(),
            spin["time_constant_up"]["value"].get<double>());
}

TEST(Motor, LeavesSpeedSpikesOut) {
  const Result result = estimate(motor(25.0, 0.8), {.disturbance = {.outliers = 0.02}});
  EXPECT_GT(result.fit["rejected"].get<int>(), 0);
  expect_holds(result, "omega_m", 25.0);
  expect_holds(result, "zeta_m", 0.8);
}

TEST(Motor, AcceptsPulseWidthsAndSeveralFiles) {
  const bench::BenchVehicle vehicle = motor(25.0, 0.8);
  bench::Random random(4);
  NumberTable first = bench::motor_steps(vehicle, random, {}).table;
  const NumberTable second = bench::motor_steps(vehicle, random, {}).table;
  for (Column& column : first.columns) {
    if (column.name != "delta") continue;
    column.name = "u";
    for (double& v : column.values) v = 1100.0 + 840.0 * v;  // [Phang 23]
  }
  const Result one = estimate_motor({first}), both = estimate_motor({first, second});
  EXPECT_TRUE(one.has_warning("command_range"));
  EXPECT_FALSE(estimate_motor({first}, {.command = CommandRange{}}).has_warning("command_range"));
  expect_holds(both, "omega_m", 25.0);
  EXPECT_LT(both.find("omega_m")->std, 0.9 * one.find("omega_m")->std);
}

TEST(Motor, RefusesRecordingsInWhichNothingHappens) {
  bench::Random random(5);
  NumberTable still = bench::motor_steps(motor(25.0, 0.8), random, {}).table;
  NumberTable constant = still;
  for (Column& column : still.columns)
    if (column.name == "omega") std::ranges::fill(column.values, 0.0);
  for (Column& column : constant.columns)
    if (column.name == "delta") std::ranges::fill(column.values, 0.5);
  EXPECT_THROW(estimate_motor({still}), DataError);
  EXPECT_THROW(estimate_motor({constant}), DataError);
}

/// The recording with a second before it in which the motor stands, is told to turn and takes 0.4 s of
/// stumbling to get going, as sensorless controllers do: not the motor's equation.
NumberTable with_start_from_rest(const NumberTable& table) {
  NumberTable result = table;
  for (Column& column : result.columns) {
    std::vector<double> values;
    for (int i = 0; i < 100; ++i) {
      const double t = 0.01 * i, ramp = std::max(0.0, (t - 0.9) / 0.1);
      values.push_back(column.name == "t"       ? t - 1.0
                       : column.name == "delta" ? (t < 0.5 ? 0.0 : 0.3)
                                                : 300.0 * ramp * ramp);
    }
    column.values.insert(column.values.begin(), values.begin(), values.end());
  }
  result.line.assign(result.columns.front().values.size(), 0);
  return result;
}

TEST(Motor, AStartFromRestThatIsNotTheMotorsEquationIsLeftOut) {
  bench::Random random(6);
  const NumberTable steps = bench::motor_steps(motor(25.0, 0.8), random, {}).table;
  const Result result = estimate_motor({with_start_from_rest(steps)});
  ASSERT_TRUE(result.has_warning("not_driven"));
  expect_holds(result, "omega_m", 25.0);
  expect_holds(result, "zeta_m", 0.8);
  expect_holds(result, "dead_time", 0.012);
}

TEST(Motor, AMotorThatObeysItsEquationFromRestAndDownToItLosesNoRow) {
  Vehicle vehicle = random_vehicle(1);
  MotorSteps steps;
  steps.levels = {0.0, 0.6, 0.3, 0.8, 0.0, 0.5};
  const NumberTable table = simulate_motor(vehicle, steps);
  const Result result = estimate_motor({table});
  EXPECT_FALSE(result.has_warning("not_driven"));
  EXPECT_EQ(result.fit["samples"].get<std::size_t>(), table.rows());
  expect_holds(result, "omega_m", vehicle.value("omega_m"));
}

TEST(Motor, ACommandThatIsWrittenLateGivesNoNegativeDeadTime) {
  bench::Random random(7);
  NumberTable table = bench::motor_steps(motor(25.0, 0.8), random, {}).table;
  for (Column& column : table.columns)
    if (column.name == "delta")  // 4 rows of 10 ms, the dead time is 12 ms
      std::rotate(column.values.rbegin(), column.values.rbegin() + 4, column.values.rend());
  for (Column& column : table.columns)
    if (column.name == "delta") std::fill_n(column.values.begin(), 4, column.values[4]);
  const Result result = estimate_motor({table});
  EXPECT_TRUE(result.has_warning("negative_dead_time"));
  EXPECT_EQ(result.find("dead_time")->value, 0.0);
  EXPECT_GE(result.find("dead_time")->ci95[0], 0.0);
}

TEST(Motor, SettledRowsOfALongRecordingChangeNothing) {
  Vehicle named = random_vehicle(1);
  named.parameters["omega_m"] = {60.0, {}}, named.parameters["zeta_m"] = {0.8, {}};
  MotorSteps steps;
  steps.hold = 5.0;
  const Result result = estimate_motor({simulate_motor(named, steps)});
  ASSERT_TRUE(result.has_warning("settled_rows"));
  EXPECT_LT(result.fit["samples"].get<int>(), 3500);  // of 7000
  expect_holds(result, "omega_m", 60.0);
  expect_holds(result, "km", named.value("km"));
}

}  // namespace
}  // namespace ident
