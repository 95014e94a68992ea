// The self-test of logs: silent on good logs of any vehicle, and right about each wrong axis and order.
#include "ident/flight/checks/log_self_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "ident/flight/make_record.h"
#include "ident/flight/prepare.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/gap/diagnose.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"
#include "ident/sim/simulate.h"
#include "support/random_vehicle.h"
#include "support/real_data.h"

namespace ident {
namespace {

std::vector<Warning> findings(const Vehicle& vehicle, const FlightLog& log) {
  std::vector<Warning> assumed;
  const std::vector<FlightLog> logs{log};
  const std::vector<double> p = starting_constants(vehicle, logs, assumed);
  return self_test(make_flight_record(vehicle, p, logs), logs, vehicle, p);
}

std::string in_words(const std::vector<Warning>& warnings) {
  std::string text;
  for (const Warning& w : warnings) text += w.code + ": " + w.message + "\n";
  return text;
}

bool names(const std::vector<Warning>& warnings, const std::string& code, const std::string& word = "") {
  return std::ranges::any_of(warnings, [&](const Warning& w) {
    return w.code == code && w.message.find(word) != std::string::npos;
  });
}

SimulationOptions flight_options(const std::string& scenario, double duration, std::uint64_t seed) {
  SimulationOptions options;
  options.scenario = scenario, options.duration = duration, options.seed = seed;
  options.rate = 200, options.longest_step = 0;
  return options;
}

void reverse(std::vector<double>& column) {
  for (double& x : column) x = -x;
}

/// A vehicle of the named layout with drag at the rotors, which the accelerometer feels.
Vehicle quad(const std::string& layout = "x") {
  Vehicle v;
  v.layout = layout, v.arm = 0.17, v.rotors = layout_rotors(layout, 0.17, 0.0);
  v.parameters = {{"m", {0.5, {}}},    {"kT", {6e-6, {}}},           {"kQ", {1e-7, {}}},
                  {"km", {900, {}}},   {"omega_m", {25, {}}},        {"zeta_m", {0.9, {}}},
                  {"Jxx", {3e-3, {}}}, {"Jyy", {3.2e-3, {}}},        {"Jzz", {5e-3, {}}},
                  {"Jp", {2e-6, {}}},  {"rotor_drag.kd", {4e-5, {}}}};
  return v;
}

FlightLog clean_log(const Vehicle& vehicle, const std::string& scenario = "mixed") {
  return simulate_flight(vehicle, flight_options(scenario, 25, 7)).log;
}

TEST(FlightSelfTest, GoodLogsOfRandomVehiclesHaveNothingAgainstTheirFrames) {
  const std::array scenarios = {"mixed", "hover", "steps", "eight", "vertical", "yaw", "phang"};
  int logs = 0;
  for (std::uint64_t seed = 1; seed <= 70; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    SimulationOptions options = flight_options(scenarios[seed % scenarios.size()], 20, seed);
    options.turbulence = seed % 3 == 0 ? 1.0 : 0.0;
    options.signals.attitude = seed % 4 == 1 ? 0 : 1;
    options.signals.velocity = seed % 4 == 2 ? 0 : 1;
    options.signals.position = seed % 5 == 3 ? 0 : 4;
    options.signals.rotor_speeds = seed % 2 ? 0 : 1;
    const std::vector<Warning> found = findings(vehicle, simulate_flight(vehicle, options).log);
    EXPECT_EQ(disqualified(found), "") << options.scenario << " " << seed;
    ++logs;
  }
  EXPECT_GE(logs, 60);
}

TEST(FlightSelfTest, ReversedRateIsNamedByItsAttitude) {
  const Vehicle vehicle = quad();
  for (std::size_t k = 0; k < 3; ++k) {
    FlightLog log = clean_log(vehicle);
    reverse(log.w_B[k]);
    const std::vector<Warning> found = findings(vehicle, log);
    EXPECT_TRUE(names(found, "sign_flipped", std::array{"p:", "q:", "r:"}[k])) << k << in_words(found);
  }
}

TEST(FlightSelfTest, ReversedRateIsNamedByTheRotorsWithoutAttitude) {
  for (const char* layout : {"x", "plus"}) {
    const Vehicle vehicle = quad(layout);
    for (std::size_t k = 0; k < 3; ++k) {
      FlightLog log = clean_log(vehicle);
      for (auto& column : log.q_WB) column.clear();
      reverse(log.w_B[k]);
      const std::vector<Warning> found = findings(vehicle, log);
      EXPECT_TRUE(names(found, "sign_flipped", std::array{"by p with", "by q with", "by r with"}[k]))
          << layout << k << in_words(found);
    }
  }
}

TEST(FlightSelfTest, ReversedAccelerometerIsNamed) {
  const Vehicle vehicle = quad();
  for (std::size_t k = 0; k < 3; ++k) {
    FlightLog log = clean_log(vehicle);
    reverse(log.f_B[k]);
    const std::vector<Warning> found = findings(vehicle, log);
    EXPECT_TRUE(k == 2 ? names(found, "wrong_frame", "az") : names(found, "sign_flipped", k ? "ay" : "ax"))
        << k << in_words(found);
  }
}

TEST(FlightSelfTest, ForeignWorldFramesAreNamed) {
  const Vehicle vehicle = quad();
  for (const bool velocity_too : {false, true}) {
    FlightLog log = clean_log(vehicle);
    std::swap(log.x_W[0], log.x_W[1]), reverse(log.x_W[2]);
    if (velocity_too) std::swap(log.v_W[0], log.v_W[1]), reverse(log.v_W[2]);
    const std::vector<Warning> found = findings(vehicle, log);
    EXPECT_TRUE(names(found, "wrong_frame", "east, north, up")) << in_words(found);
  }
  FlightLog log = clean_log(vehicle);
  for (auto& column : log.v_W) column.clear();
  reverse(log.x_W[1]), reverse(log.x_W[2]);
  EXPECT_TRUE(names(findings(vehicle, log), "wrong_frame", "north, west, up"))
      << in_words(findings(vehicle, log));
}

TEST(FlightSelfTest, AttitudeOfTheWorldInTheBodyIsNamed) {
  const Vehicle vehicle = quad();
  FlightLog log = clean_log(vehicle);
  for (std::size_t k = 1; k < 4; ++k) reverse(log.q_WB[k]);
  EXPECT_TRUE(names(findings(vehicle, log), "wrong_frame", "conjugate")) << in_words(findings(vehicle, log));
}

TEST(FlightSelfTest, EveryWrongRotorOrderIsNamedRightly) {
  for (const char* layout : {"x", "plus"}) {
    const Vehicle vehicle = quad(layout);
    const FlightLog right = simulate_flight(vehicle, flight_options("mixed", 15, 7)).log;
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    while (std::ranges::next_permutation(order).found) {
      FlightLog log = right;
      std::string fitting;  // column that drives each rotor: rotor order[n] was written to column n
      for (std::size_t n = 0; n < 4; ++n) {
        log.delta[order[n]] = right.delta[n], log.Omega[order[n]] = right.Omega[n];
        fitting += " " + std::to_string(order[n] + 1);
      }
      const std::vector<Warning> found = findings(vehicle, log);
      EXPECT_TRUE(names(found, "motor_order", "rotor order" + fitting)) << layout << fitting << "\n"
                                                                        << in_words(found);
    }
  }
}

TEST(FlightSelfTest, LogsThatSayLittleAreNamed) {
  const Vehicle vehicle = quad();
  FlightLog still = clean_log(vehicle);
  Random random(3);
  for (auto& column : still.delta)
    for (double& x : column) x = 0.5 + 0.001 * random.normal();
  for (auto& column : still.Omega)
    for (double& x : column) x = 450 + random.normal();
  for (auto& column : still.w_B)
    for (double& x : column) x = 0.01 * random.normal();
  for (auto& column : still.f_B)
    for (double& x : column) x = (&column == &still.f_B[2] ? -9.81 : 0.0) + 0.05 * random.normal();
  for (auto& column : still.q_WB) column.clear();
  for (auto& column : still.v_W) column.clear();
  for (auto& column : still.x_W) column.clear();
  EXPECT_TRUE(names(findings(vehicle, still), "hover_only")) << in_words(findings(vehicle, still));

  FlightLog limited = clean_log(vehicle);
  for (std::size_t i = 0; i < limited.rows(); i += 20) limited.delta[1][i] = 1.0;
  EXPECT_TRUE(names(findings(vehicle, limited), "saturated_commands"));

  const FlightLog fine = clean_log(vehicle);
  for (const auto& [steps, told] : {std::pair(12.0, true), {100.0, true}, {250.0, false}, {1000.0, false}}) {
    FlightLog coarse = fine;
    for (auto& column : coarse.delta)
      for (double& x : column) x = std::round(steps * x) / steps;
    EXPECT_EQ(names(findings(vehicle, coarse), "coarse_commands"), told) << steps;
  }

  SimulationOptions slow = flight_options("mixed", 10, 1);
  slow.rate = 20, slow.longest_step = 5e-3;
  const std::vector<Warning> found = findings(vehicle, simulate_flight(vehicle, slow).log);
  EXPECT_TRUE(names(found, "low_rate"));
  EXPECT_TRUE(names(found, "short_log"));
  EXPECT_EQ(in_words(findings(vehicle, clean_log(vehicle))), "");
}

TEST(FlightSelfTest, WrongOrderLeavesNoNumberStanding) {
  Vehicle vehicle = quad();
  SimulationOptions brief = flight_options("hover", 6, 7);
  brief.rate = 100;
  FlightLog log = simulate_flight(vehicle, brief).log;
  std::swap(log.delta[0], log.delta[1]);
  const std::vector<FlightLog> logs{log};
  for (const Result& result : {refine_flight(vehicle, logs), diagnose_gap(vehicle, logs).result}) {
    EXPECT_TRUE(result.has_warning("motor_order"));
    EXPECT_EQ(result.verdict.find("motor_order: "), 0u) << result.verdict;
    EXPECT_FALSE(result.parameters.empty());
    for (const Parameter& p : result.parameters) EXPECT_FALSE(p.identifiable) << p.name;
    if (result.command == "gap") {
      EXPECT_EQ(result.extra["verdict"]["status"], "unknown");
    }
  }
}

// The rotors of both Crazyflies, as the README beside the recordings gives them.
Vehicle crazyflie() {
  Vehicle v;
  v.parameters = {{"m", {0.027, {}}}};
  for (const auto& [x, y, s] : {std::tuple(1, 1, 1), {-1, 1, -1}, {-1, -1, 1}, {1, -1, -1}}) {
    Rotor rotor;
    rotor.r_B = {0.028 * x, 0.028 * y, 0};
    rotor.s = s;
    v.rotors.push_back(rotor);
  }
  return v;
}

const std::string kMaps = std::string(IDENT_SOURCE_DIR) + "/data/maps/";

TEST(FlightSelfTest, RealSystemIdentificationFlightHasItsRotorsInOrder) {
  IDENT_NEEDS_REAL_DATA(folder);
  Vehicle vehicle = crazyflie();
  for (const char* n : {"10", "15", "16"}) {
    const FlightLog log = read_flight_log(folder + "/flight/arplab_crazyflie/log" + n + ".csv", vehicle,
                                          read_log_map(kMaps + "arplab_crazyflie_log" + n + ".yaml"));
    EXPECT_EQ(disqualified(findings(vehicle, log)), "") << n;
    if (std::string(n) != "15") continue;
    std::swap(vehicle.rotors[0], vehicle.rotors[1]);
    EXPECT_TRUE(names(findings(vehicle, log), "motor_order", "rotor order 2 1 3 4"))
        << in_words(findings(vehicle, log));
    std::swap(vehicle.rotors[0], vehicle.rotors[1]);
  }
}

TEST(FlightSelfTest, RealFlightsUnderMotionCaptureHaveNothingAgainstTheirFrames) {
  IDENT_NEEDS_REAL_DATA(folder);
  for (const char* name : {"B2_circle_slow_rep2", "B3_figure8_fast_rep1", "B5_helix_fast_rep1",
                           "B6_linear_ramp_rep3", "B8_star_fast_rep2", "B9_trefoil_medium_rep4"}) {
    const FlightLog log = read_flight_log(folder + "/flight/nanobench/" + name + ".csv", crazyflie(),
                                          read_log_map(kMaps + "nanobench_crazyflie.yaml"));
    EXPECT_EQ(disqualified(findings(crazyflie(), log)), "") << name;
  }
}

// Grams for kilograms, or a vehicle that stands on the ground with its rotors turning.
TEST(FlightSelfTest, ThrustFarFromTheWeightIsNamed) {
  const FlightLog log = clean_log(quad());
  EXPECT_FALSE(names(findings(quad(), log), "thrust_weight"));
  for (const double factor : {1000.0, 0.1}) {
    Vehicle wrong = quad();
    wrong.parameters["m"].value *= factor;
    const std::vector<Warning> found = findings(wrong, log);
    EXPECT_TRUE(names(found, "thrust_weight")) << in_words(found);
    EXPECT_NE(disqualified(found), "");
  }
}

TEST(FlightSelfTest, SpeedsInAnotherUnitAreNamed) {
  FlightLog log = clean_log(quad());
  log.delta.clear();
  EXPECT_FALSE(names(findings(quad(), log), "thrust_weight"));
  const auto scaled = [&](double factor) {
    FlightLog other = log;
    for (auto& column : other.Omega)
      for (double& x : column) x *= factor;
    return findings(quad(), other);
  };
  constexpr double kPerMinute = 60 / (2 * std::numbers::pi);
  EXPECT_TRUE(names(scaled(kPerMinute), "thrust_weight", "turns a minute that are taken for rad/s"));
  EXPECT_TRUE(names(scaled(1 / kPerMinute), "thrust_weight", "rad/s that are taken for turns a minute"));
  EXPECT_FALSE(names(scaled(1.4), "thrust_weight"));
}

}  // namespace
}  // namespace ident
