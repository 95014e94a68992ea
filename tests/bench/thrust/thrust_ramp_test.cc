// Long tables without a time column: ramps of a stand, and rows in which its speed sensor saw nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <random>

#include "ident/bench/thrust/thrust_sweep.h"

namespace ident {
namespace {

constexpr double kThrust = 6e-6, kTare = 0.2;  // N s^2/rad^2, N

/// Ramps up and down between 1100 and 1900 us, every command some rows long.
NumberTable ramps(std::size_t rows, std::size_t rows_of_a_command, double speed_noise) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> u, Omega, thrust;
  for (std::size_t i = 0; i < rows; ++i) {
    const double place = static_cast<double>(i / rows_of_a_command) * static_cast<double>(rows_of_a_command);
    const double phase = std::fmod(place / 1000.0, 2.0);
    u.push_back(1100.0 + 800.0 * (phase < 1.0 ? phase : 2.0 - phase));
    const double speed = u.back() - 900.0;
    Omega.push_back(speed + speed_noise * normal(random));
    thrust.push_back(kTare + kThrust * speed * speed + 0.01 * normal(random));
  }
  NumberTable table{.file = "ramp.csv"};
  table.columns = {{"u", "ESC", u}, {"omega", "omega", Omega}, {"thrust", "thrust", thrust}};
  for (std::size_t i = 0; i < rows; ++i) table.line.push_back(static_cast<long>(i) + 2);
  return table;
}

double seconds_for(std::size_t rows) {
  const NumberTable table = ramps(rows, 2, 5.0);
  const std::clock_t begin = std::clock();
  estimate_thrust({table});
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

TEST(ThrustRamp, CostsNoMoreThanInProportionToItsRows) {
  const double few = seconds_for(3000), many = seconds_for(24000);
  EXPECT_LT(many, 8.0 * few + 0.5);
  EXPECT_LT(many, 2.0);  // 0.1 s on a machine of its own
}

/// 5 rad/s of noise would make the plain fit's kT 0.06 % too small at these speeds, 30 rad/s 2 %.
TEST(ThrustRamp, NoiseOfTheSpeedDoesNotReachTheConstant) {
  for (const double noise : {1.0, 5.0, 30.0}) {
    const Result result = estimate_thrust({ramps(12000, 2, noise)});
    EXPECT_TRUE(result.has_warning("averaged_ramp"));
    const Parameter& kT = *result.find("kT");
    EXPECT_NEAR(kT.value, kThrust, 5.0 * kT.std) << noise;
    EXPECT_LT(kT.std, 0.005 * kThrust) << noise;
  }
}

TEST(ThrustRamp, AShortSweepIsStillFittedRowByRow) {
  const Result result = estimate_thrust({ramps(60, 5, 5.0)});
  EXPECT_FALSE(result.has_warning("averaged_ramp"));
}

TEST(ThrustRamp, ASpeedOfZeroWhereTheRotorTurnsElsewhereIsNoRest) {
  NumberTable table = ramps(600, 5, 1.0);
  std::vector<double>& Omega = table.columns[1].values;
  for (std::size_t i = 100; i < 300; ++i) Omega[i] = 0.0;  // thrust goes on
  const Result result = estimate_thrust({table});
  EXPECT_TRUE(result.has_warning("speed_missed"));
  EXPECT_NEAR(result.find("kT")->value, kThrust, 5.0 * result.find("kT")->std);
}

}  // namespace
}  // namespace ident
