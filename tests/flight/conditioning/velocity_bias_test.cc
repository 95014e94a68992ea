// Velocities that are off by a constant: seen by positions, taken out, and no gap.
#include <gtest/gtest.h>

#include "ident/flight/make_record.h"
#include "ident/flight/refine.h"
#include "support/diagnosed.h"

namespace ident {
namespace {

constexpr std::array kOff = {0.06, -0.04, 0.0};

FlightLog flown(std::uint64_t seed, const char* noise = "typical") {
  SimulationOptions options;
  options.duration = 30.0, options.rate = 100.0, options.seed = seed, options.noise = noise_level(noise);
  return simulate_flight(testing::published_vehicle(), options).log;
}

FlightLog biased(FlightLog log) {
  for (std::size_t k = 0; k < 3; ++k)
    for (double& v : log.v_W[k]) v += kOff[k];
  return log;
}

FlightRecord record_of(const Vehicle& vehicle, std::vector<FlightLog> logs) {
  return make_flight_record(vehicle, parameter_vector(vehicle), logs);
}

double mean_difference(const FlightRecord& a, const FlightRecord& b, int channel) {
  double sum = 0;
  const std::size_t rows = a.arcs[0].rows();
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t at = i * kChannels + static_cast<std::size_t>(channel);
    sum += (a.arcs[0].y[at] - b.arcs[0].y[at]) / static_cast<double>(rows);
  }
  return sum;
}

auto told(const FlightRecord& record) {
  return std::ranges::count(record.warnings, "velocity_bias", &Warning::code);
}

TEST(VelocityBias, IsTakenOutOfTheLogThatHasIt) {
  const Vehicle vehicle = testing::published_vehicle();
  const FlightRecord plain = record_of(vehicle, {flown(1), flown(2)});
  const FlightRecord record = record_of(vehicle, {biased(flown(1)), flown(2)});
  EXPECT_EQ(told(plain), 0);
  EXPECT_EQ(told(record), 1);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(mean_difference(record, plain, kVelocity + k), 0.0, 0.004) << k;
  EXPECT_EQ(record.arcs[0].y[kVelocity + 2], plain.arcs[0].y[kVelocity + 2]);  // an axis without any
  for (std::size_t i = 0; i < plain.arcs[1].rows(); ++i)
    ASSERT_EQ(record.arcs[1].y[i * kChannels + kVelocity], plain.arcs[1].y[i * kChannels + kVelocity]) << i;
}

TEST(VelocityBias, IsNeitherDriftNorSeenWithoutPositions) {
  const Vehicle vehicle = testing::published_vehicle();
  FlightLog drifting = flown(3), blind = biased(flown(3));
  for (std::size_t i = 0; i < drifting.rows(); ++i)
    drifting.x_W[0][i] += 0.3 * std::sin(0.9 * drifting.t[i]) + 0.2 * std::sin(0.31 * drifting.t[i]);
  EXPECT_EQ(told(record_of(vehicle, {drifting})), 0);
  for (auto& column : blind.x_W) column.clear();
  const FlightRecord record = record_of(vehicle, {blind});
  EXPECT_EQ(told(record), 0);
  EXPECT_EQ(record.arcs[0].y[kVelocity], blind.v_W[0][blind.rows() - record.arcs[0].rows()]);
}

TEST(VelocityBias, IsNoGap) {
  const Vehicle vehicle = testing::published_vehicle();
  EXPECT_EQ(testing::verdict_of(vehicle, biased(flown(4)))["status"], "none");
}

// Exact positions and rare samples: the slope of what is integrated is the bias all the same.
TEST(VelocityBias, IsFoundInRareSamples) {
  const Vehicle vehicle = testing::published_vehicle();
  FlightLog log = biased(flown(5, "low"));
  const FlightLog plain = flown(5, "low");
  for (std::size_t i = 0; i < log.rows(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      if (i % 10 != 0) log.x_W[k][i] = kNaN;
      if (i % 4 != 0) log.v_W[k][i] = kNaN;
    }
  const FlightRecord record = record_of(vehicle, {log});
  ASSERT_EQ(told(record), 1);
  for (int k = 0; k < 2; ++k) {
    double sum = 0, n = 0;
    const FlightArc& arc = record.arcs[0];
    const std::size_t first = log.rows() - arc.rows();
    for (std::size_t i = 0; i < arc.rows(); ++i)
      if (const double v = arc.y[i * kChannels + static_cast<std::size_t>(kVelocity + k)]; std::isfinite(v))
        sum += v - plain.v_W[static_cast<std::size_t>(k)][first + i], n += 1;
    EXPECT_NEAR(sum / n, 0.0, 0.004) << k;
  }
}

}  // namespace
}  // namespace ident
