// Sensors whose noise was filtered are thinned until it is white; others are left alone.
#include "ident/flight/conditioning/decimate_filtered.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/random.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/sim/simulate.h"
#include "support/known_quad.h"
#include "support/random_vehicle.h"

namespace ident {
namespace {

using Sensor = std::array<std::vector<double>, 3>;

// What a second-order Butterworth filter makes of a column sampled at `rate`.
void filter(std::vector<double>& x, double cutoff, double rate) {
  const double k = std::tan(M_PI * cutoff / rate), n = 1 / (1 + std::sqrt(2.0) * k + k * k);
  const double b0 = k * k * n, a1 = 2 * (k * k - 1) * n, a2 = (1 - std::sqrt(2.0) * k + k * k) * n;
  double x1 = x[0], x2 = x[0], y1 = x[0], y2 = x[0];
  for (double& value : x) {
    const double y = b0 * (value + 2 * x1 + x2) - a1 * y1 - a2 * y2;
    x2 = x1, x1 = value, y2 = y1, y1 = y, value = y;
  }
}

std::vector<double> times(std::size_t rows, double rate) {
  std::vector<double> t(rows);
  for (std::size_t i = 0; i < rows; ++i) t[i] = static_cast<double>(i) / rate;
  return t;
}

// A motion with noise on it that was filtered at `cutoff` Hz (0: was not).
Sensor shown(const std::vector<double>& t, double rate, double noise, double cutoff, std::uint64_t seed) {
  Random random(seed);
  Sensor out;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double at : t)
      out[k].push_back(std::sin((2.0 + static_cast<double>(k)) * at) + noise * random.normal());
    if (cutoff > 0) filter(out[k], cutoff, rate);
  }
  return out;
}

double next_correlation(const std::vector<double>& noise, std::size_t stride) {
  double same = 0, next = 0;
  for (std::size_t i = 0; i + stride < noise.size(); i += stride)
    same += noise[i] * noise[i], next += noise[i] * noise[i + stride];
  return next / same;
}

TEST(WhiteStride, WhiteNoiseIsLeftAlone) {
  for (const double rate : {50.0, 100.0, 250.0, 1000.0})
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      const auto t = times(seed % 2 == 0 ? 20'000 : 1500, rate);
      EXPECT_EQ(white_stride(t, shown(t, rate, 0.02, 0, seed)), 1u) << rate << " Hz, " << seed;
    }
}

TEST(WhiteStride, WithoutNoiseNothingIsLeftOut) {
  const auto t = times(5000, 500);
  EXPECT_EQ(white_stride(t, shown(t, 500, 0, 0, 1)), 1u);
}

TEST(WhiteStride, DecimatedFilteredNoiseIsAboutWhite) {
  for (const double rate : {250.0, 400.0, 1000.0})
    for (const double cutoff : {40.0, 60.0, 90.0}) {
      const auto t = times(20'000, rate);
      const std::size_t stride = white_stride(t, shown(t, rate, 0.02, cutoff, 3));
      std::vector<double> noise(t.size());
      Random random(3);
      for (double& x : noise) x = random.normal();
      filter(noise, cutoff, rate);
      EXPECT_LT(std::abs(next_correlation(noise, stride)), 0.25) << rate << " Hz, " << cutoff << " Hz";
      EXPECT_LE(stride, static_cast<std::size_t>(0.016 * rate));
    }
}

TEST(WhitenedSensors, DecimatesAndWarns) {
  FlightLog log;
  log.file = "fast.csv", log.t = times(10'000, 1000);
  log.w_B = shown(log.t, 1000, 0.02, 50, 1), log.f_B = shown(log.t, 1000, 0.1, 0, 2);
  log.q_WB[0].assign(log.rows(), 1.0);
  for (std::size_t k = 1; k < 4; ++k) log.q_WB[k].assign(log.rows(), 0.0);
  std::vector<Warning> warnings;
  const std::vector<FlightLog> out = whitened_sensors(std::span(&log, 1), warnings);
  ASSERT_EQ(out.size(), 1u);
  const std::size_t stride = white_stride(log.t, log.w_B);
  ASSERT_GT(stride, 1u);
  for (std::size_t i = 0; i < log.rows(); ++i) {
    ASSERT_EQ(std::isfinite(out[0].w_B[1][i]), i % stride == 0) << i;
    ASSERT_EQ(out[0].f_B[1][i], log.f_B[1][i]);
  }
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, "filtered_noise");
  EXPECT_NE(warnings[0].message.find("fast.csv: p q r"), std::string::npos) << warnings[0].message;
}

// Without attitude more samples of one sensor would decide between two that are late differently.
TEST(WhitenedSensors, DecimatesBothSensorsAlikeWithoutAttitude) {
  FlightLog log;
  log.file = "fast.csv", log.t = times(10'000, 1000);
  log.w_B = shown(log.t, 1000, 0.02, 50, 1), log.f_B = shown(log.t, 1000, 0.1, 0, 2);
  for (auto& column : log.f_B)  // at half the rate of the rates
    for (std::size_t i = 1; i < column.size(); i += 2) column[i] = kNaN;
  std::vector<Warning> warnings;
  const std::vector<FlightLog> out = whitened_sensors(std::span(&log, 1), warnings);
  ASSERT_EQ(out.size(), 1u);
  const auto left = [](const std::vector<double>& column) {
    return static_cast<double>(std::ranges::count_if(column, [](double y) { return std::isfinite(y); }));
  };
  EXPECT_LT(left(out[0].w_B[1]), 3000);
  EXPECT_NEAR(left(out[0].f_B[1]), left(out[0].w_B[1]), 0.15 * left(out[0].w_B[1]));
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[1].message.find("ax ay az: as few samples as of the other sensor"), std::string::npos)
      << warnings[1].message;
}

// Counted as white, noise below 45 Hz in a log of 1000 Hz passes for gusts, and what the rotors do is lost in
// them: inertias came out fifteen times less well known.
TEST(WhitenedSensors, FilteredNoiseIsNotEstimatedAsGusts) {
  const Vehicle truth = random_vehicle(4);
  SimulationOptions options;
  options.duration = 30, options.rate = 1000, options.seed = 4;
  FlightLog log = simulate_flight(truth, options).log;
  log.Omega.clear();
  Random random(9);
  for (auto* sensor : {&log.w_B, &log.f_B})
    for (auto& column : *sensor) {
      const double more = sensor == &log.w_B ? 0.02 : 0.3;  // that a filter then takes most of
      for (double& value : column) value += more * random.normal();
      filter(column, 45, 1000);
    }
  Vehicle model = truth;
  for (const char* name : {"Jxx", "Jyy"}) {
    const double value = truth.parameters.at(name).value;
    model.parameters[name].value = 1.2 * value, model.parameters[name].std = 0.3 * value;
  }
  const Result found = refine_flight(model, std::span(&log, 1), {.shown = Shown::numbers});
  for (const char* name : {"Jxx", "Jyy"}) {
    const double value = truth.parameters.at(name).value;
    const Parameter* p = found.find(name);
    ASSERT_NE(p, nullptr);
    EXPECT_LT(std::abs(p->value - value), 4 * p->std) << name << ' ' << p->value << " not " << value;
    EXPECT_LT(p->std, 5e-4 * value) << name;
  }
}

// Of rates and forces alone, behind filters of their own: what these make late is in the motors' lag, and
// said to be; a free dead time takes it, and the moments of inertia are right with either.
TEST(WhitenedSensors, FilterLagIsReportedWithoutAttitude) {
  const Vehicle truth = testing::quad(0.0);
  SimulationOptions options;
  options.duration = 20, options.rate = 1000, options.seed = 4;
  FlightLog log = simulate_flight(truth, options).log;
  log.Omega.clear();
  for (auto& column : log.q_WB) column.clear();
  for (std::size_t k = 0; k < 3; ++k) log.v_W[k].clear(), log.x_W[k].clear();
  Random random(9);
  for (auto* sensor : {&log.w_B, &log.f_B})
    for (auto& column : *sensor) {
      const bool rates = sensor == &log.w_B;
      for (double& value : column) value += (rates ? 0.02 : 0.3) * random.normal();
      filter(column, rates ? 80 : 30, 1000);
    }
  Vehicle stated = testing::known(truth);
  stated.parameters.erase("dead_time");
  const double omega_m = truth.value("omega_m");
  const auto expect_body = [&](const Result& found, double within) {
    for (const char* name : {"Jxx", "Jyy", "Jzz"})
      EXPECT_NEAR(found.find(name)->value / truth.value(name), 1.0, within) << name;
  };
  const Result held = refine_flight(stated, std::span(&log, 1), {.validate = false});
  EXPECT_TRUE(held.has_warning("filter_lag"));
  EXPECT_LT(held.find("omega_m")->value, 0.97 * omega_m);
  EXPECT_FALSE(held.find("omega_m")->identifiable);
  expect_body(held, 0.03);
  const Result freed = refine_flight(stated, std::span(&log, 1), {.free = {"dead_time"}, .validate = false});
  EXPECT_FALSE(freed.has_warning("filter_lag"));
  EXPECT_NEAR(freed.find("omega_m")->value, omega_m, 0.01 * omega_m);
  EXPECT_NEAR(freed.find("dead_time")->value, 0.0028, 0.0006);  // of a filter at 80 Hz
  expect_body(freed, 0.02);
}

}  // namespace
}  // namespace ident
