// What a file makes up for of what it cannot hold.
#include "ident/gap/fix/refit.h"

#include <gtest/gtest.h>

#include "ident/io/simulators/simulators.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using testing::flight;
using testing::quad;

TEST(Refit, MakesUpForARotorThatIsWeakerThanTheOthers) {
  Vehicle whole = quad(0.0);
  whole.parameters["rotor_mismatch.ratio@1"] = {0.8, {}};
  const std::vector<FlightLog> logs{flight(whole, 250, 3, 20.0)};
  const Vehicle held = held_by(find_simulator("rotorpy"), whole);
  ASSERT_EQ(held.value("kT"), whole.value("kT"));
  const Vehicle out = refitted(held, whole, logs);
  const auto thrust = [](const Vehicle& v) { return v.value("kT") * v.value("km") * v.value("km"); };
  // It turns faster by 1/sqrt(0.8) to balance: 4/(3 + 1/0.8) of the thrust is what four equal ones have.
  EXPECT_NEAR(thrust(out) / thrust(whole), 0.941, 0.01);
}

TEST(Refit, ChangesNothingOfWhatTheFileHolds) {
  const Vehicle whole = held_by(find_simulator("rotorpy"), quad(0.0));
  const std::vector<FlightLog> logs{flight(quad(0.0), 250, 3, 10.0)};
  const Vehicle held = held_by(find_simulator("rotorpy"), whole), out = refitted(held, whole, logs);
  for (const auto& [name, known] : held.parameters) EXPECT_EQ(out.value(name), known.value) << name;
}

TEST(Refit, LeavesAFileAsItIsWithoutFlight) {
  Vehicle whole = quad(0.0);
  whole.parameters["rotor_mismatch.ratio@1"] = {0.8, {}};
  const Vehicle held = held_by(find_simulator("rotorpy"), whole);
  EXPECT_EQ(refitted(held, whole, {}).value("kT"), held.value("kT"));
}

}  // namespace
}  // namespace ident
