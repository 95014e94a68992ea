// Rotor speeds of logs in the place of an assumed one.
#include "ident/io/simulators/logged_speeds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/io/simulators/simulators.h"
#include "io/simulators/simulator_vehicles.h"
#include "support/known_quad.h"
#include "support/run_program.h"

namespace ident {
namespace {

using testing::flight;
using testing::quad;

// The vehicle as a file without speeds has it: at 1000 rad/s, with the same thrust and torque.
Vehicle at_assumed_speed() {
  Vehicle v = quad(0.0);
  const double factor = 1000.0 / v.value("km");
  v.parameters["km"].value = 1000.0;
  for (const char* name : {"kT", "kQ"}) v.parameters[name].value /= factor * factor;
  v.parameters["Jp"].value /= factor;
  return v;
}

void expect_true_speeds(const Vehicle& out) {
  for (const char* name : {"km", "kT", "kQ", "Jp"})
    EXPECT_NEAR(out.value(name) / quad(0.0).value(name), 1.0, 0.03) << name;
}

TEST(LoggedSpeeds, ComeFromTheCommandsBesideThem) {
  const std::vector<FlightLog> logs{flight(quad(0.0), 250, 3, 10.0)};
  expect_true_speeds(with_logged_speeds(at_assumed_speed(), logs));
}

TEST(LoggedSpeeds, ComeFromTheWeightWithoutCommands) {
  std::vector<FlightLog> logs{flight(quad(0.0), 250, 3, 10.0)};
  logs[0].delta.clear();
  expect_true_speeds(with_logged_speeds(at_assumed_speed(), logs));
}

TEST(LoggedSpeeds, ChangeNothingWhereNoneWereLogged) {
  std::vector<FlightLog> logs{flight(quad(0.0), 250, 3, 10.0)};
  logs[0].Omega.clear();
  EXPECT_EQ(with_logged_speeds(at_assumed_speed(), logs).value("km"), 1000.0);
}

TEST(LoggedSpeeds, AreForFilesThatStateNone) {
  const std::string folder = test_folder();
  for (const auto& [target, assumed] :
       {std::pair("mujoco", true), {"px4-sih", true}, {"ardupilot", true}, {"gz", false}, {"rotorpy", false}})
    EXPECT_EQ(assumes_rotor_speeds(
                  write_text(folder, std::string(target) + ".file",
                             export_to_simulator(find_simulator(target), test::plain_quadrotor()).text)),
              assumed)
        << target;
}

}  // namespace
}  // namespace ident
