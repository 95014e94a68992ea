// A battery's voltage as its sensor shows it and as it was.
#include "ident/flight/conditioning/smooth_voltage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/random.h"
#include "ident/flight/record/initial_states.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "support/known_quad.h"

namespace ident {
namespace {

constexpr double kFull = 4.2, kNoise = 0.02;  // V

Vehicle with_battery(double n) {
  Vehicle vehicle = testing::quad();
  vehicle.battery_voltage = kFull;
  vehicle.parameters["battery_sag.n"].value = n;
  return vehicle;
}

// Its battery hardly empties: what the voltage changes by is what the load takes.
FlightLog flown(std::uint64_t seed, int every = 25) {
  SimulationOptions options;
  options.duration = 40, options.seed = seed, options.battery_used = 0.02;
  options.noise.voltage = 0;
  options.signals.rotor_speeds = 0, options.signals.battery = every;  // 10 Hz
  return simulate_flight(with_battery(1.0), options).log;
}

FlightLog with_noise(FlightLog log, std::uint64_t seed, double noise = kNoise) {
  Random random(seed);
  for (double& v : log.vbat)
    if (std::isfinite(v)) v += noise * random.normal();
  return log;
}

double rms_between(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isfinite(a[i]) && std::isfinite(b[i])) sum += std::pow(a[i] - b[i], 2), count += 1;
  return std::sqrt(sum / count);
}

bool is_as_logged(const FlightLog& log) {
  const std::vector<double> quiet = quiet_voltage(log);
  bool same = quiet.size() == log.vbat.size();
  for (std::size_t i = 0; i < quiet.size() && same; ++i)
    same = std::isnan(quiet[i]) ? std::isnan(log.vbat[i]) : quiet[i] == log.vbat[i];
  return same;
}

TEST(QuietVoltage, IsCloserToTheTruthThanTheLog) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const FlightLog truth = flown(seed), log = with_noise(truth, seed);
    EXPECT_NEAR(rms_between(log.vbat, truth.vbat), kNoise, 0.15 * kNoise);
    EXPECT_LT(rms_between(quiet_voltage(log), truth.vbat), 0.4 * kNoise) << seed;
  }
}

TEST(QuietVoltage, WithoutNoiseIsAsLogged) {
  const FlightLog log = flown(1, 1);
  EXPECT_TRUE(is_as_logged(log));
  FlightLog constant = log;
  for (double& v : constant.vbat) v = 11.1;
  EXPECT_LT(rms_between(quiet_voltage(constant), constant.vbat), 1e-12);
}

TEST(QuietVoltage, NeedsSamplesAndCommands) {
  FlightLog log = with_noise(flown(1), 1);
  FlightLog without = log;
  without.delta.clear();
  EXPECT_TRUE(is_as_logged(without));
  std::size_t kept = 0;
  for (double& v : log.vbat)
    if (std::isfinite(v) && ++kept > 40) v = kNaN;
  EXPECT_TRUE(is_as_logged(log));
  log.vbat.clear();
  EXPECT_TRUE(quiet_voltage(log).empty());
}

// How far off it is by the load, of how far lines between every so many rows are.
double share_of_lines(std::size_t every, double noise, std::uint64_t seed) {
  const FlightLog truth = flown(seed, 1);
  FlightLog log = with_noise(truth, seed, noise);
  for (std::size_t i = 0; i < log.rows(); ++i)
    if (i % every != 0) log.vbat[i] = kNaN;
  return rms_between(interpolated(log.t, quiet_voltage(log)), truth.vbat) /
         rms_between(interpolated(log.t, log.vbat), truth.vbat);
}

// A sensor with hardly any noise too.
TEST(QuietVoltage, GoesWithTheLoadBetweenSamples) {
  for (const double noise : {0.0, 0.002, kNoise}) EXPECT_LT(share_of_lines(25, noise, 3), 0.9) << noise;
  for (const double noise : {0.002, kNoise}) EXPECT_LT(share_of_lines(150, noise, 4), 0.6) << noise;
}

TEST(QuietVoltage, ABadSampleIsNoNoise) {
  const FlightLog truth = flown(5);
  for (const double bad : {0.5, 1.1, 10.0}) {
    FlightLog log = with_noise(truth, 5);
    std::size_t at = log.rows() / 2;
    while (std::isnan(log.vbat[at])) ++at;
    log.vbat[at] *= bad;
    EXPECT_LT(rms_between(quiet_voltage(log), truth.vbat), 0.4 * kNoise) << bad;
  }
}

// What a sensor shows before it is ready.
TEST(QuietVoltage, LeavesOutWhatIsNoVoltage) {
  const FlightLog truth = flown(2);
  FlightLog log = with_noise(truth, 2);
  for (std::size_t i = 0; i < log.rows() / 20; ++i)
    if (std::isfinite(log.vbat[i])) log.vbat[i] = 0.0;
  const std::vector<double> quiet = quiet_voltage(log);
  for (const double v : quiet) EXPECT_NEAR(v, kFull, 0.5);
}

// Its noise would pass for sag that the motors do not feel: half of it was found then.
TEST(QuietVoltage, GivesAnUnbiasedSagExponent) {
  Vehicle vehicle = testing::known(with_battery(0.8));
  vehicle.parameters["battery_sag.n"].std = 0.4;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Result result =
        refine_flight(vehicle, std::vector{with_noise(flown(seed), seed)}, {.validate = false});
    const Parameter& n = *result.find("battery_sag.n");
    EXPECT_NEAR(n.value, 1.0, 0.1) << n.std;
    EXPECT_TRUE(n.identifiable);
  }
}

}  // namespace
}  // namespace ident
