// What a refinement leaves in a parameter file is the model that it found, and nothing that it does not
// trust.
#include <gtest/gtest.h>

#include <cmath>

#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "ident/sim/simulate.h"

namespace ident {
namespace {

Vehicle feasible() {
  Vehicle v = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  v.command.reset();  // commands need not be whole microseconds
  return v;
}

// Of a log without rotor speeds only kT km^2 can be known, here to 0.2 %: each is left with half of its
// deviation and more, and what was stated of them was 12 % off together.
TEST(FlightStored, CorrelatedConstantsAreStoredTogether) {
  const Vehicle truth = feasible();
  Vehicle stated = truth;
  for (const char* name : {"kT", "kQ", "km"}) {
    const double value = truth.value(name);
    stated.parameters[name] = {1.04 * value, 0.05 * value};
  }
  stated.parameters["Jp"].std = 0.1 * truth.value("Jp");
  SimulationOptions options;
  options.duration = 20.0;
  options.signals.rotor_speeds = 0;
  const FlightLog log = simulate_flight(truth, options).log;
  const Result result = refine_flight(stated, std::span(&log, 1), {.validate = false});
  ASSERT_FALSE(result.find("kT")->identifiable && result.find("km")->identifiable);
  const Vehicle stored = with_parameters(stated, with_result({}, result));
  const auto lifts = [](const Vehicle& v) { return v.value("kT") * std::pow(v.value("km"), 2); };
  EXPECT_NEAR(lifts(stated) / lifts(truth), 1.125, 0.001);
  EXPECT_NEAR(lifts(stored) / lifts(truth), 1.0, 0.01);
  EXPECT_GT(stored.parameters.at("kT").std.value(), 0.5 * 0.05 * truth.value("kT"));
}

TEST(FlightStored, UntrustedConstantsAreNotStored) {
  Result result;
  for (const char* name : {"kT", "km", "omega_m"}) {
    Parameter p;
    p.name = name, p.value = 2.0, p.std = 0.5;
    result.parameters.push_back(p);
  }
  result.parameters[1].identifiable = false, result.parameters[1].joint = true;
  result.parameters[1].note = "these logs say little";
  EXPECT_EQ(with_result({}, result).parameters.size(), 3u);
  for (Parameter& p : result.parameters)
    if (p.name != "omega_m") p.doubt("thrust is wrong");
  const Vehicle stored = with_result({}, result);
  EXPECT_EQ(stored.parameters.size(), 1u);
  EXPECT_TRUE(stored.has("omega_m"));
  EXPECT_EQ(result.parameters[0].note, "thrust is wrong");
  EXPECT_EQ(result.parameters[1].note, "these logs say little") << "it was not known before";
}

}  // namespace
}  // namespace ident
