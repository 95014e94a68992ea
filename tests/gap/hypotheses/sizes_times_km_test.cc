// What turns with rotors whose speed is not measured is known times km: its size is free as that product, and
// then is not given up for a km along a straight line.
#include <gtest/gtest.h>

#include "ident/flight/make_record.h"
#include "ident/gap/hypotheses/candidates.h"
#include "ident/gap/hypotheses/next_model.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/sim/simulate.h"

namespace ident {
namespace {

Vehicle published() { return read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml"); }

FreeConstant size_of(const std::string& cause, const Vehicle& vehicle, const Signals& signals) {
  return constants_of({.name = cause}, vehicle, parameter_vector(vehicle), signals).front();
}

TEST(SizesTimesKm, OnlyOfWhatTurnsWithRotorsKnownByCommands) {
  const Vehicle vehicle = published();
  Signals signals;
  signals.commands = true;
  for (const char* cause : {"rotor_drag", "axial_inflow", "blade_flapping"})
    EXPECT_EQ(size_of(cause, vehicle, signals).times, param::km) << cause;
  for (const char* cause : {"parasitic_drag", "translational_lift", "ground_effect"})
    EXPECT_EQ(size_of(cause, vehicle, signals).times, -1) << cause;
  signals.rotor_speeds = true;
  EXPECT_EQ(size_of("rotor_drag", vehicle, signals).times, -1);
  signals.commands = false;
  EXPECT_EQ(size_of("rotor_drag", vehicle, signals).times, -1);
}

TEST(SizesTimesKm, SlopesAreThoseOfTheValues) {
  const Vehicle vehicle = published();
  const std::vector<double> p = parameter_vector(vehicle);
  Signals signals;
  signals.commands = true;
  std::vector<FreeConstant> constants = free_constants(vehicle, p);
  constants.push_back(size_of("rotor_drag", vehicle, signals));
  constants.back().start = 2e-5;
  const Theta theta(p, constants, 1, false);
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(theta.size(), -0.2, 0.3);
  const Eigen::MatrixXd J = theta.slopes(u);
  for (int k = 0; k < theta.size(); ++k) {
    Eigen::VectorXd later = u, before = u;
    later[k] += 1e-5, before[k] -= 1e-5;
    for (int i = 0; i < theta.size(); ++i)
      EXPECT_NEAR(J(i, k), (theta.physical(later, i) - theta.physical(before, i)) / 2e-5,
                  1e-6 * std::abs(theta.physical(u, i)))
          << theta.name(i) << " by " << theta.name(k);
  }
}

// Nothing is stated of kT and km but what a flight tells, which is their product.
TEST(SizesTimesKm, ADragIsNotGivenUpForASpeedThatNobodyKnows) {
  Vehicle flown = published();
  flown.parameters.erase("Jp");  // which goes with km as well
  Vehicle stated = flown;
  flown.parameters["rotor_drag.kd"] = {3e-5, {}};
  SimulationOptions options;
  options.duration = 25.0, options.rate = 100.0, options.scenario = "eight";
  FlightLog log = simulate_flight(flown, options).log;
  log.Omega.clear();
  for (auto& [name, known] : stated.parameters) known.std.reset();
  const std::vector<double> p = parameter_vector(stated);
  const std::vector<FlightLog> logs{log};
  const FlightRecord record = make_flight_record(stated, p, logs);
  Standing at = standing_at(record, stated, {}, fitted(free_constants(stated, p), {}, record, p, {}));
  const Candidate drag{.name = "rotor_drag"};
  at = standing_at(record, stated, {},
                   with_causes(record, stated, at, places_of({drag}, at.problem), {.estimate_noise = true}));
  ASSERT_EQ(at.have.size(), 1U);
  const double gain = gain_of(at.form, at.problem, at.have).gain - gain_of(at.form, at.problem, {}).gain;
  EXPECT_GT(gain, 500) << gain;
}

}  // namespace
}  // namespace ident
