// Rotors in another order, spinning the other way round, or under sensors that are turned: named as such.
#include <gtest/gtest.h>

#include <algorithm>

#include "ident/flight/checks/log_self_test.h"
#include "ident/flight/make_record.h"
#include "ident/flight/prepare.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/sim/simulate.h"
#include "support/ring_of_rotors.h"

namespace ident {
namespace {

using testing::ring_of_rotors;

FlightLog flown(const Vehicle& vehicle) {
  SimulationOptions options;
  options.scenario = "mixed", options.duration = 16, options.seed = 7, options.rate = 200;
  options.longest_step = 0;
  return simulate_flight(vehicle, options).log;
}

std::string findings(const Vehicle& vehicle, const FlightLog& log) {
  std::vector<Warning> assumed;
  const std::vector<FlightLog> logs{log};
  const std::vector<double> p = starting_constants(vehicle, logs, assumed);
  std::string text;
  for (const Warning& w : self_test(make_flight_record(vehicle, p, logs), logs, vehicle, p))
    text += w.code + ": " + w.message + "\n";
  return text;
}

bool has(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

TEST(RotorOrder, OfSixAndEightRotorsIsNamed) {
  const std::vector<std::vector<std::size_t>> orders = {{5, 0, 1, 2, 3, 4},
                                                        {4, 0, 3, 5, 1, 2},
                                                        {2, 0, 1, 3, 4, 5},
                                                        {5, 4, 3, 2, 1, 0, 7, 6},
                                                        {3, 6, 1, 4, 7, 0, 2, 5}};
  for (const std::vector<std::size_t>& order : orders) {
    const Vehicle vehicle = ring_of_rotors(static_cast<int>(order.size()));
    const FlightLog right = flown(vehicle);
    EXPECT_EQ(findings(vehicle, right), "");
    FlightLog log = right;
    std::string fitting = "rotor order";
    for (std::size_t n = 0; n < order.size(); ++n) {
      log.delta[order[n]] = right.delta[n], log.Omega[order[n]] = right.Omega[n];
      fitting += " " + std::to_string(order[n] + 1);
    }
    EXPECT_TRUE(has(findings(vehicle, log), "motor_order")) << fitting;
    EXPECT_TRUE(has(findings(vehicle, log), fitting)) << fitting << "\n" << findings(vehicle, log);
  }
}

TEST(RotorOrder, RotorsThatSpinTheOtherWayRoundAreNamed) {
  for (const int rotors : {4, 6}) {
    Vehicle vehicle = ring_of_rotors(rotors);
    FlightLog log = flown(vehicle);
    for (Rotor& rotor : vehicle.rotors) rotor.s = -rotor.s;
    EXPECT_TRUE(has(findings(vehicle, log), "rotor_spin")) << findings(vehicle, log);
    const std::vector<FlightLog> logs{log};
    const Result result = refine_flight(vehicle, logs, {.shown = Shown::numbers});
    for (const Parameter& p : result.parameters) EXPECT_FALSE(p.identifiable) << p.name;
    // Without attitude it may as well be the gyro.
    for (auto& column : log.q_WB) column.clear();
    EXPECT_TRUE(has(findings(vehicle, log), "r with the sign reversed, or as well by every rotor spinning"))
        << findings(vehicle, log);
  }
}

TEST(RotorOrder, SensorsTurnedByAQuarterAreNamed) {
  for (const int rotors : {4, 6})
    for (const bool clockwise : {false, true}) {
      const Vehicle vehicle = ring_of_rotors(rotors);
      FlightLog log = flown(vehicle);
      for (auto* of : {&log.w_B, &log.f_B}) {
        std::swap((*of)[0], (*of)[1]);  // along x what the vehicle feels along y, or the other way
        for (double& x : (*of)[clockwise ? 0 : 1]) x = -x;
      }
      for (auto& column : log.q_WB) column.clear();
      for (auto& column : log.v_W) column.clear();
      for (auto& column : log.x_W) column.clear();
      EXPECT_TRUE(has(findings(vehicle, log),
                      clockwise ? "p read from q and q from -p" : "p read from -q and q from p"))
          << findings(vehicle, log);
    }
}

}  // namespace
}  // namespace ident
