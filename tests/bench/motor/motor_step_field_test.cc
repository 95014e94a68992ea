// Step recordings as recorders make them: steps at another dead time each, pauses, transients that no
// equation of second order holds, two speeds, ends that were cut off.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ident/bench/motor/motor_step.h"
#include "ident/bench/motor/motor_step_edges.h"
#include "ident/bench/motor/motor_step_model.h"
#include "ident/core/error.h"

namespace ident {
namespace {

/// A recording of steps between levels of 1000 rad/s per unit command.
struct Recording {
  double omega_m = 60.0, zeta_m = 0.9, noise = 1.0, step = 0.005, plateau = 0.6;
  std::vector<double> delta = {0.3, 0.5, 0.4, 0.7, 0.5, 0.8, 0.3, 0.6};
  std::vector<double> dead_time = {0.012};  ///< of the steps, in turn
  double bend = 0.0;                        ///< share of a slow second lag in the answer

  NumberTable table() const {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    NumberTable table{.file = "steps.csv"};
    std::vector<double> t, command, Omega;
    for (double now = 0.0; now < plateau * static_cast<double>(delta.size()); now += step) {
      double speed = 1000.0 * delta[0];
      const auto at = static_cast<std::size_t>((now + 1e-9) / plateau);
      for (std::size_t e = 1; e < delta.size(); ++e) {
        const double since = now - plateau * static_cast<double>(e),
                     dead = dead_time[(e - 1) % dead_time.size()];
        const double answer = step_answer({omega_m, zeta_m, dead}, since).value;
        const double slow = step_answer({0.3 * omega_m, 1.0, dead}, since).value;
        speed += 1000.0 * (delta[e] - delta[e - 1]) * ((1.0 - bend) * answer + bend * slow);
      }
      t.push_back(now), command.push_back(delta[std::min(at, delta.size() - 1)]);
      Omega.push_back(speed + noise * normal(random));
    }
    for (std::size_t i = 0; i < t.size(); ++i) table.line.push_back(static_cast<long>(i) + 2);
    table.columns = {{"t", "t", t}, {"delta", "delta", command}, {"omega", "omega", Omega}};
    return table;
  }
};

/// Without the rows in (from, until) after each change of the command.
NumberTable with_pauses(NumberTable table, double from, double until) {
  const std::vector<double> t = *table.find("t"), delta = *table.find("delta");
  std::vector<bool> keep(t.size(), true);
  double edge = -1.0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (delta[i] != delta[i - 1]) edge = t[i];
    keep[i] = edge < 0.0 || t[i] - edge <= from || t[i] - edge >= until;
  }
  const auto cut = [&](auto& values) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (keep[i]) values[kept++] = values[i];
    values.resize(kept);
  };
  for (Column& column : table.columns) cut(column.values);
  cut(table.line);
  return table;
}

TEST(MotorEdges, HaveTheSlopesOfTheirDifferencesAndTheirSumIsThatOfTheDeadTime) {
  StepRecord record{.file = "steps.csv"};
  for (int i = 0; i < 80; ++i) record.t.push_back(0.01 * i);
  record.Omega.assign(80, 0.0);
  record.edges = {{0.0, 0.2}, {0.1037, 0.7}, {0.2511, 0.4, true}, {0.43, 0.9}};
  const Eigen::Vector4d target(200.0, 700.0, 400.0, 900.0);
  const Eigen::Vector2d start(200.0, 0.0);
  for (const double ratio : {1.0, 0.5}) {
    const MotorShape shape{35.0, 0.8, 0.0137, ratio};
    const auto speeds = [&](const StepRecord& at) -> Eigen::VectorXd {
      const Eigen::Vector3d c(1.0, start(0), start(1));
      return motor_responses(at, target, shape, Slopes::no).value * c;
    };
    const Eigen::MatrixXd slopes = edge_time_slopes(record, target, start, shape);
    for (Eigen::Index e = 0; e < 3; ++e) {
      const Eigen::VectorXd move = 1e-7 * Eigen::VectorXd::Unit(3, e);
      const Eigen::VectorXd difference =
          (speeds(with_shifted_edges(record, move)) - speeds(with_shifted_edges(record, -move))) / 2e-7;
      EXPECT_LT((slopes.col(e) - difference).cwiseAbs().maxCoeff(), 1e-4 * difference.cwiseAbs().maxCoeff());
    }
    const MotorResponses all = motor_responses(record, target, shape, Slopes::yes);
    const Eigen::VectorXd dead_time = all.slope[2] * Eigen::Vector3d(1.0, start(0), start(1));
    EXPECT_LT((slopes.rowwise().sum() - dead_time).cwiseAbs().maxCoeff(),
              1e-9 * dead_time.cwiseAbs().maxCoeff());
  }
}

TEST(MotorField, StepsWithDeadTimesOfTheirOwnDoNotReachTheMotor) {
  const Recording recording{.dead_time = {0.012, 0.06, 0.013, 0.05, 0.011}};
  const Result result = estimate_motor({recording.table()});
  ASSERT_TRUE(result.has_warning("dead_time_varies"));
  for (const auto& [name, truth] : {std::pair("omega_m", 60.0), {"zeta_m", 0.9}, {"km", 1000.0}})
    EXPECT_NEAR(result.find(name)->value, truth, 5.0 * result.find(name)->std) << name;
  EXPECT_LT(result.find("omega_m")->std, 1.5);
  EXPECT_GT(result.find("dead_time")->std, 0.01);
}

TEST(MotorField, APauseOfTheRecorderInTheAnswerIsSaid) {
  const Recording recording{.dead_time = {0.012, 0.07, 0.012, 0.065}};
  const Result result = estimate_motor({with_pauses(recording.table(), 0.012, 0.08)});
  EXPECT_TRUE(result.has_warning("recorder_pauses"));
  EXPECT_NEAR(result.find("omega_m")->value, 60.0, 5.0 * result.find("omega_m")->std);
  EXPECT_NEAR(result.find("km")->value, 1000.0, 5.0 * result.find("km")->std);
}

TEST(MotorField, ARecordingWithOneDeadTimeHasOne) {
  const Result result = estimate_motor({Recording{}.table()});
  for (const char* code : {"dead_time_varies", "transient_misfit", "recorder_pauses", "static_curve"})
    EXPECT_FALSE(result.has_warning(code)) << code;
  EXPECT_NEAR(result.find("dead_time")->value, 0.012, 5.0 * result.find("dead_time")->std);
}

/// The slow lag makes 2 zeta/omega longer: 0.9 30 ms + 0.1 (0.3 36.7 ms/0.3).
TEST(MotorField, TransientsThatMissTheEquationByMoreThanNoiseAreStillFitted) {
  for (const double noise : {0.01, 0.1, 1.0}) {
    Recording recording{.noise = noise, .bend = 0.1};
    const Result result = estimate_motor({recording.table()});
    EXPECT_GT(result.fit["r2"].get<double>(), 0.999) << noise;
    EXPECT_LT(result.fit["rejected"].get<int>(), 20) << noise;
    const double lag = 0.9 * 2.0 * 0.9 / 60.0 + 0.1 * 2.0 / (0.3 * 60.0);
    EXPECT_NEAR(result.extra["lag"]["value"].get<double>() + result.find("dead_time")->value, lag + 0.012,
                0.004)
        << noise;
  }
}

TEST(MotorField, TwoSpeedsAreComparedAsThrustComparesThem) {
  NumberTable table = Recording{}.table();
  Column electrical{"omega_electrical", "Motor Electrical Speed", *table.find("omega")};
  for (double& v : electrical.values) v *= 7.0 / 6.0;
  table.columns[2].name = "omega_optical";
  table.columns.push_back(electrical);
  const Result result = estimate_motor({table});
  EXPECT_TRUE(result.has_warning("pole_count"));
  EXPECT_NEAR(result.find("km")->value, 1000.0, 5.0 * result.find("km")->std);
}

TEST(MotorField, ARecordingOfAnyLengthEndsWithAnAnswerOrAnError) {
  const NumberTable whole = Recording{.plateau = 0.1}.table();
  for (std::size_t rows = 1; rows < whole.rows(); rows += 7) {
    NumberTable part = whole;
    for (Column& column : part.columns) column.values.resize(rows);
    part.line.resize(rows);
    part.columns[2].values.back() = 3.0;  // a number that was cut
    try {
      EXPECT_TRUE(std::isfinite(estimate_motor({part}).find("km")->value)) << rows;
    } catch (const DataError&) {
    }
  }
}

}  // namespace
}  // namespace ident
