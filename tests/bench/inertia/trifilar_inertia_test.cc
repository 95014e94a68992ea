// The trifilar pendulum: exact period, reductions, interval, and what it says about bad input.
#include "ident/bench/inertia/trifilar_inertia.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/error.h"
#include "ident/model/trifilar_period.h"
#include "support/bench_campaign.h"

namespace ident {
namespace {

const TrifilarSuspension kSuspension{
    .mass = 1.3, .gravity = 9.81, .radius_squared = 0.04, .length = 0.5, .amplitude = 0.6};

/// Period by integrating the equation of motion, d/dt (M theta') - M' theta'^2/2 + V' = 0.
double integrated_period(const TrifilarSuspension& s, double J) {
  const auto h = [&](double a) {
    return std::sqrt(s.length * s.length - 4 * s.radius_squared * std::pow(std::sin(a / 2), 2));
  };
  const auto M = [&](double a) { return J + s.mass * std::pow(s.radius_squared * std::sin(a) / h(a), 2); };
  const auto acceleration = [&](double a, double w) {
    const double e = 1e-5, M_slope = (M(a + e) - M(a - e)) / (2 * e);
    const double V_slope = s.mass * s.gravity * s.radius_squared * std::sin(a) / h(a);
    return (-V_slope - 0.5 * M_slope * w * w) / M(a);
  };
  double a = s.amplitude, w = 0.0, t = 0.0;
  const double dt = 1e-4;
  while (a > 0.0) {
    const double k1 = acceleration(a, w), a2 = a + dt / 2 * w, w2 = w + dt / 2 * k1;
    const double k2 = acceleration(a2, w2), a3 = a + dt / 2 * w2, w3 = w + dt / 2 * k2;
    const double k3 = acceleration(a3, w3), a4 = a + dt * w3, w4 = w + dt * k3;
    const double next = a + dt / 6 * (w + 2 * w2 + 2 * w3 + w4);
    if (next <= 0.0) return 4.0 * (t + dt * a / (a - next));
    w += dt / 6 * (k1 + 2 * k2 + 2 * k3 + acceleration(a4, w4));
    a = next;
    t += dt;
  }
  return 4.0 * t;
}

TEST(TrifilarPeriod, EqualsThatOfTheIntegratedEquationOfMotion) {
  const double J = 0.02;
  EXPECT_NEAR(trifilar_period(kSuspension, J).period, integrated_period(kSuspension, J), 1e-7);
}

TEST(TrifilarPeriod, BeginsWithTheCorrectionOfSecondOrder) {
  TrifilarSuspension s = kSuspension;
  const double J = 0.02, r2 = s.radius_squared, L = s.length;
  s.amplitude = 0.0;
  const double T_0 = trifilar_period(s, J).period;
  EXPECT_NEAR(T_0, 2 * M_PI * std::sqrt(J * L / (s.mass * s.gravity * r2)), 1e-14);
  s.amplitude = 0.02;
  const double second = 1.0 / 16 - 3 * r2 / (16 * L * L) + s.mass * r2 * r2 / (4 * J * L * L);
  EXPECT_NEAR((trifilar_period(s, J).period / T_0 - 1.0) / (0.02 * 0.02), second, 1e-4);
}

TEST(TrifilarPeriod, HasTheDerivativeOfItsDifferences) {
  const double J = 0.02, e = 1e-6;
  const double slope =
      (trifilar_period(kSuspension, J + e).period - trifilar_period(kSuspension, J - e).period) / (2 * e);
  EXPECT_NEAR(trifilar_period(kSuspension, J).slope, slope, 1e-6 * slope);
}

TEST(TrifilarPeriod, IsInvertedAtAnyAmplitude) {
  for (const double amplitude : {0.0, 0.1, 1.0}) {
    TrifilarSuspension s = kSuspension;
    s.amplitude = amplitude;
    EXPECT_NEAR(trifilar_inertia(s, trifilar_period(s, 0.02).period), 0.02, 1e-14);
  }
}

struct Row {
  std::string axis;
  double period, mass, offset = 0.0, amplitude = 0.0, std = kNaN;
};

constexpr double kRadius = 0.15, kLength = 1.1;

NumberTable table(const std::vector<Row>& rows) {
  NumberTable t{.file = "pendulum.csv"};
  t.text = {{.name = "axis"}};
  for (const char* name : {"period", "mass", "offset", "amplitude", "std", "radius", "length"})
    t.columns.push_back({.name = name});
  for (const Row& row : rows) {
    t.text[0].values.push_back(row.axis);
    const std::array values = {row.period, row.mass, row.offset, row.amplitude, row.std, kRadius, kLength};
    for (std::size_t k = 0; k < values.size(); ++k) t.columns[k].values.push_back(values[k]);
    t.line.push_back(static_cast<long>(t.line.size()) + 2);
  }
  return t;
}

/// The formula of the file format description, solved for the period.
double period_of(double J_v, double J_platform, double m_v, double m_p, double offset) {
  const double m = m_v + m_p, c = m_v * offset / m;
  const double J = J_v + J_platform + m_v * m_p / m * offset * offset;
  return std::sqrt(4 * M_PI * M_PI * kLength * J / (m * 9.81 * (kRadius * kRadius - c * c)));
}

std::vector<Row> exact_rows(double Jxx, double Jyy, double Jzz) {
  const double J_p = 0.003;
  return {{"x", period_of(Jxx, J_p, 0.5, 0.2, 0.01), 0.7, 0.01},
          {"y", period_of(Jyy, J_p, 0.5, 0.2, 0.02), 0.7, 0.02},
          {"z", period_of(Jzz, J_p, 0.5, 0.2, 0.0), 0.7},
          {"platform", period_of(0.0, J_p, 0.0, 0.2, 0.0), 0.2}};
}

TEST(Inertia, InvertsTheFormulaOfTheFileFormatExactly) {
  const Result result = estimate_inertia({table(exact_rows(2.9e-3, 3.1e-3, 5.5e-3))});
  EXPECT_NEAR(result.find("Jxx")->value, 2.9e-3, 1e-12);
  EXPECT_NEAR(result.find("Jyy")->value, 3.1e-3, 1e-12);
  EXPECT_NEAR(result.find("Jzz")->value, 5.5e-3, 1e-12);
  EXPECT_FALSE(result.has_warning("triangle_inequality"));
}

TEST(Inertia, SaysThatSingleRowsHaveNoUncertainty) {
  const Result result = estimate_inertia({table(exact_rows(2.9e-3, 3.1e-3, 5.5e-3))});
  EXPECT_TRUE(result.has_warning("no_repeats"));
  EXPECT_FALSE(std::isfinite(result.find("Jxx")->std));
  EXPECT_FALSE(result.find("Jxx")->identifiable);
}

TEST(Inertia, PropagatesTheStatedDeviationOfAPeriod) {
  std::vector<Row> rows = exact_rows(2.9e-3, 3.1e-3, 5.5e-3);
  for (Row& row : rows) row.std = 1e-3;
  const Result result = estimate_inertia({table(rows)});
  // dJ/dT = 2 J/T for the hanging body and for the platform; the two errors are independent.
  const double hanging = 2 * (5.5e-3 + 0.003) / rows[2].period * 1e-3,
               platform = 2 * 0.003 / rows[3].period * 1e-3;
  EXPECT_NEAR(result.find("Jzz")->std, std::hypot(hanging, platform), 1e-9);
  // The platform's is the same in all of them.
  const double common = platform * platform / (result.find("Jzz")->std * result.find("Jxx")->std);
  EXPECT_NEAR(result.correlation.of("Jxx", "Jzz"), common, 1e-6);
  EXPECT_FALSE(result.has_warning("no_repeats"));
}

TEST(Inertia, TakesTheAmplitudeIntoAccount) {
  const double J_p = 0.003;
  TrifilarSuspension loaded{
      .mass = 0.7, .radius_squared = kRadius * kRadius, .length = kLength, .amplitude = 0.5};
  TrifilarSuspension empty = loaded;
  empty.mass = 0.2;
  const double T = trifilar_period(loaded, 5.5e-3 + J_p).period, T_p = trifilar_period(empty, J_p).period;
  const Result with = estimate_inertia({table({{"z", T, 0.7, 0, 0.5}, {"platform", T_p, 0.2, 0, 0.5}})});
  const Result without = estimate_inertia({table({{"z", T, 0.7}, {"platform", T_p, 0.2}})});
  EXPECT_NEAR(with.find("Jzz")->value, 5.5e-3, 1e-12);
  EXPECT_GT(without.find("Jzz")->value, 5.5e-3 * 1.03);  // 2 theta_0^2/16 = 3 %
}

TEST(Inertia, ReportsAViolatedTriangleInequalityWithItsNumbers) {
  const Result result = estimate_inertia({table(exact_rows(1.0e-3, 1.0e-3, 2.4e-3))});
  ASSERT_TRUE(result.has_warning("triangle_inequality"));
  EXPECT_NEAR(result.extra["triangle"][2]["value"].get<double>(), -0.4e-3, 1e-12);
}

TEST(Inertia, LeavesAGrossTimingErrorOut) {
  bench::Random random(3);
  const bench::BenchVehicle vehicle = bench::random_vehicle(random);
  bench::GeneratedTable data = bench::pendulum(vehicle, random, 5, {});
  const Result before = estimate_inertia({data.table});
  data.table.columns[0].values[7] *= 1.5;  // a miscounted oscillation
  const Result after = estimate_inertia({data.table});
  EXPECT_TRUE(after.has_warning("outlier"));
  EXPECT_NEAR(after.find("Jyy")->value, before.find("Jyy")->value, 3 * before.find("Jyy")->std);
}

TEST(Inertia, FollowsTheScatterWhereTheStatedDeviationIsTooSmall) {
  bench::Random random(5);
  const bench::BenchVehicle vehicle = bench::random_vehicle(random);
  bench::GeneratedTable data = bench::pendulum(vehicle, random, 8, {});
  const Result free = estimate_inertia({data.table});
  data.table.columns.push_back(
      {.name = "std", .values = std::vector<double>(data.table.rows(), 0.1 * data.noise)});
  const Result stated = estimate_inertia({data.table});
  EXPECT_TRUE(stated.has_warning("period_scatter"));
  EXPECT_NEAR(stated.find("Jxx")->std, free.find("Jxx")->std, 1e-6 * free.find("Jxx")->std);
}

TEST(Inertia, RefusesWhatCannotBeWithItsLine) {
  std::vector<Row> rows = exact_rows(1e-3, 1e-3, 2e-3);
  rows[1].mass = 0.1;  // less than the platform
  try {
    estimate_inertia({table(rows)});
    FAIL() << "accepted a vehicle of negative mass";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("pendulum.csv:3: mass:"), std::string::npos) << error.what();
  }
  rows = {exact_rows(1e-3, 1e-3, 2e-3)[3]};
  EXPECT_THROW(estimate_inertia({table(rows)}), DataError);
}

TEST(Inertia, OfAPropellerIsThatOfAPlate) {
  // 0.012 kg (0.02^2 + 0.25^2) m^2/12
  EXPECT_NEAR(propeller_inertia(0.012, 0.02, 0.25).value, 6.29e-5, 1e-12);
  EXPECT_THROW(propeller_inertia(0.012, 0.0, 0.25), UsageError);
}

}  // namespace
}  // namespace ident
