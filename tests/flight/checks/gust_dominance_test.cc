// How much of what turns a vehicle is the air, and what is not known then.
#include "ident/flight/checks/gust_dominance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/flight/make_record.h"
#include "support/known_quad.h"

namespace ident {
namespace {

AirShare share_in(double gusts) {
  SimulationOptions options;
  options.duration = 20, options.turbulence = gusts, options.by_gyro = true;
  const std::vector<FlightLog> logs{simulate_flight(testing::quad(), options).log};
  const Vehicle vehicle = testing::known(testing::quad());
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), record.logs, true);
  return air_share(record, fit_flight(record, theta, {}));
}

TEST(AirShare, RotorsDoWhatTheAirDoesNot) {
  TurnedBy turned;
  turned.add(0.1, {0.2, 0.0, 0.3}, {1.0, 1.0, 3.0});  // rotors: 1, -1 and 0 rad/s^2
  turned.add(0.1, {0.2, 0.0, 0.3}, {1.0, 1.0, 3.0});
  EXPECT_NEAR(turned.air_over_rotors()[0], 1.0, 1e-12);
  EXPECT_NEAR(turned.air_over_rotors()[1], 1.0, 1e-12);
  turned.add(0.2, {0.8, 0.0, 0.0}, {0.0, 0.0, 0.0});  // 4 rad/s^2, by the rotors alone
  EXPECT_NEAR(turned.air_over_rotors()[0], std::sqrt(0.2 / 3.4), 1e-12);
}

TEST(AirShare, GrowsWithTheGusts) {
  const AirShare still = share_in(0), light = share_in(0.5), strong = share_in(2.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_LT(still.over_rotors[axis], 0.2);
    EXPECT_LT(light.over_rotors[axis], strong.over_rotors[axis]);
    EXPECT_GT(strong.seconds[axis], 0.5);
  }
}

std::string not_known_in(const AirShare& air) {
  Result result;
  for (const char* name : {"kT", "kQ", "omega_m", "Jxx", "Jyy", "Jzz", "Jp", "m"})
    result.parameters.push_back({.name = name, .value = 1.0, .std = 0.01});
  warn_of_air(result, air);
  std::string names = result.has_warning("air_turns") ? "" : "nothing";
  for (const Parameter& p : result.parameters)
    if (!p.identifiable) names += p.name + " ";
  return names;
}

TEST(AirShare, QuickGustsLeaveOpenWhatTurnsAboutTheirAxes) {
  EXPECT_EQ(not_known_in({{0.4, 0.4, 0.4}, {0.3, 0.3, 0.3}}), "nothing");
  EXPECT_EQ(not_known_in({{0.8, 0.8, 0.8}, {1.5, 1.5, 1.5}}), "nothing") << "slow ones";
  EXPECT_EQ(not_known_in({{0.8, 0.2, 0.2}, {0.3, 0.3, 0.3}}), "kT omega_m Jxx ");
  EXPECT_EQ(not_known_in({{0.2, 0.2, 0.8}, {0.3, 0.3, 0.3}}), "kQ Jzz Jp ");
  EXPECT_EQ(not_known_in({{0.8, 0.8, 0.2}, {0.3, 1.5, 0.3}}), "kT omega_m Jxx Jyy ") << "one speaks for all";
  EXPECT_EQ(not_known_in({{0.55, 0.45, 0.2}, {0.3, 0.3, 0.3}}), "kT omega_m Jxx Jyy ") << "nearly as strong";
  EXPECT_EQ(not_known_in({{0.8, 0.8, 0.2}, {1.5, 1.5, 0.3}}), "nothing") << "but not one that is weak";
  EXPECT_EQ(not_known_in({{0.6, 0.6, 0.2}, {0.7, 0.7, 0.7}}), "nothing") << "stronger ones only";
  EXPECT_EQ(not_known_in({{0.8, 0.2, 0.2}, {0.7, 0.7, 0.7}}), "kT omega_m Jxx ");
}

}  // namespace
}  // namespace ident
