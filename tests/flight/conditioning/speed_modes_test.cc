// Rotor speeds smoothed together: small differences between rotors that change together come out whole.
#include "ident/flight/conditioning/speed_modes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/random.h"
#include "ident/flight/conditioning/speed_smoother.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using Columns = std::vector<std::vector<double>>;

Eigen::MatrixXd modes_of(const Vehicle& vehicle) { return speed_modes(vehicle, parameter_vector(vehicle)); }

std::vector<double> along(const Columns& speeds, const Eigen::RowVectorXd& mode) {
  std::vector<double> out(speeds[0].size(), 0.0);
  for (std::size_t n = 0; n < speeds.size(); ++n)
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += mode[static_cast<Eigen::Index>(n)] * speeds[n][i];
  return out;
}

// Slope of the true values over those found: 1 where noise weakens nothing.
double slope_of(const std::vector<double>& truth, const std::vector<double>& found) {
  double xy = 0, xx = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) xy += found[i] * truth[i], xx += found[i] * found[i];
  return xy / xx;
}

// Four rotors that climb and sink together, and roll a little.
struct Flown {
  explicit Flown(double noise) {
    Random random(21);
    for (int i = 0; i < 10000; ++i) {
      const double at = i / 250.0, together = 900 + 60 * std::sin(5 * at) + 30 * std::sin(11 * at);
      t.push_back(at), roll.push_back(1.5 * std::sin(3 * at) + std::sin(1.7 * at));
      for (std::size_t n = 0; n < 4; ++n)
        seen[n].push_back(together + modes(1, static_cast<Eigen::Index>(n)) * roll.back() +
                          noise * random.normal());
    }
  }
  Eigen::MatrixXd modes = modes_of(testing::quad());
  std::vector<double> t, roll;
  Columns seen = Columns(4);
};

TEST(SpeedModes, AreOrthogonalAndOneLiftsOneRollsOnePitchesOneYaws) {
  Vehicle vehicle = testing::quad();
  for (const bool six : {false, true}) {
    if (six)
      for (const int side : {1, -1})
        vehicle.rotors.push_back({.r_B = {0.0, 0.3 * side, 0.0}, .a_B = {0, 0, -1}, .s = side});
    const Eigen::MatrixXd modes = modes_of(vehicle);
    const auto rotors = static_cast<Eigen::Index>(vehicle.rotors.size());
    EXPECT_TRUE((modes * modes.transpose()).isIdentity(1e-12));
    EXPECT_NEAR(std::abs(modes.row(0).sum()), std::sqrt(static_cast<double>(rotors)), 1e-9) << "lifts";
    // What each of the later ones does: no lift, the last of six no moment either.
    for (Eigen::Index mode = 1; mode < rotors; ++mode) EXPECT_NEAR(modes.row(mode).sum(), 0.0, 1e-9) << mode;
    Eigen::MatrixXd arms(rotors, 2);
    for (Eigen::Index n = 0; n < rotors; ++n)
      arms.row(n) = vehicle.rotors[static_cast<std::size_t>(n)].r_B.head<2>();
    EXPECT_GT(std::abs((modes.row(1) * arms.col(1)).value()), 0.1) << "rolls";
    EXPECT_NEAR((modes.row(2) * arms.col(1)).value(), 0.0, 1e-9) << "pitches";
    for (Eigen::Index mode = 3; mode < rotors; ++mode)
      EXPECT_LT((modes.row(mode) * arms).cwiseAbs().maxCoeff(), 1e-9) << mode;
  }
}

TEST(SpeedModes, SmallDifferencesAreNotAttenuated) {
  const Flown flown(5.0);
  const SmoothedSpeeds found = smoothed_speeds(flown.t, flown.seen, flown.modes);
  EXPECT_NEAR(slope_of(flown.roll, along(found.likely, flown.modes.row(1))), 1.0, 0.1);
  // Each rotor by itself follows the common motion, and noise with it.
  Columns apart;
  for (const auto& column : flown.seen) apart.push_back(smoothed_speed(flown.t, column).likely);
  EXPECT_LT(slope_of(flown.roll, along(apart, flown.modes.row(1))), 0.75);
  // And what is left of the noise is stated by mode.
  const std::vector<double> roll = along(found.likely, flown.modes.row(1));
  double square = 0, stated = 0;
  for (std::size_t i = 0; i < roll.size(); ++i)
    square += std::pow(roll[i] - flown.roll[i], 2), stated += found.errors.variance[1][i];
  EXPECT_NEAR(square / stated, 1.0, 0.5);
  EXPECT_EQ(found.errors.modes, flown.modes);
}

TEST(SpeedModes, SpeedsWithoutNoiseStayAsTheyAre) {
  const Flown flown(0.0);
  const SmoothedSpeeds found = smoothed_speeds(flown.t, flown.seen, flown.modes);
  for (std::size_t n = 0; n < 4; ++n)
    for (std::size_t i = 0; i < flown.t.size(); ++i)
      ASSERT_NEAR(found.likely[n][i], flown.seen[n][i], 1e-2) << n << " " << i;
}

// Telemetry that brings one rotor after the other says nothing of differences at one time.
TEST(SpeedModes, RotorsThatAreSampledInTurnAreSmoothedEachByItself) {
  Flown flown(5.0);
  for (std::size_t i = 1; i < flown.t.size(); ++i)
    for (std::size_t n = 0; n < 4; ++n)
      if (i % 4 != n) flown.seen[n][i] = flown.seen[n][i - 1];
  const SmoothedSpeeds found = smoothed_speeds(flown.t, flown.seen, flown.modes);
  EXPECT_EQ(found.errors.modes.size(), 0);
  for (std::size_t n = 0; n < 4; ++n)
    EXPECT_EQ(found.likely[n], smoothed_speed(flown.t, flown.seen[n]).likely) << n;
}

TEST(SpeedModes, ARotorWithoutAnySampleGivesNoSpeeds) {
  Flown flown(5.0);
  flown.seen[2].assign(flown.t.size(), kNaN);
  const SmoothedSpeeds found = smoothed_speeds(flown.t, flown.seen, flown.modes);
  EXPECT_TRUE(found.likely[2].empty());
  EXPECT_EQ(found.likely[0].size(), flown.t.size());
}

}  // namespace
}  // namespace ident
