// What the channels ask of a cause found: the same where it is the true one.
#include "ident/gap/statistics/by_channel.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ident/flight/make_record.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/sim/simulate.h"

namespace ident {
namespace {

FlightLog flight_of(const Vehicle& vehicle, int rotor_speeds = 1) {
  SimulationOptions options;
  options.duration = 20.0;
  options.rate = 100.0;
  options.seed = 3;
  options.signals.rotor_speeds = rotor_speeds;
  return simulate_flight(vehicle, options).log;
}

// What is asked of a constant where it is taken for wrong.
std::vector<Asked> asked_of(const std::string& name, const Vehicle& model, const FlightLog& log) {
  const std::vector<double> p = parameter_vector(model);
  const std::vector<FlightLog> logs{log};
  const FlightRecord record = make_flight_record(model, p, logs);
  const std::vector<FreeConstant> constants = free_constants(model, p);
  Candidate cause{"parameter:" + name};
  cause.parameter =
      static_cast<int>(std::ranges::find(constants, name, &FreeConstant::name) - constants.begin());
  return asked_by_channels(fitted(constants, {cause}, record, p, {}))[0];
}

TEST(ByChannel, AllAskForTheSameSizeOfTheTrueCause) {
  const Vehicle truth = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  Vehicle model = truth;
  for (auto& [name, parameter] : model.parameters) parameter.std = 0.01 * std::abs(parameter.value);
  model.parameters.at("km").value *= 1.1;
  double weights = 0;
  for (const Asked& a : asked_of("km", model, flight_of(truth))) {
    EXPECT_LT(std::abs(a.change), std::max(3.5 * a.std, 0.05)) << a.part;
    weights += a.weight;
  }
  EXPECT_NEAR(weights, 1.0, 1e-3);  // next to nothing of it is known beforehand
}

TEST(ByChannel, RotorSpeedsThatNobodyMeasuredAreNotSaidToTell) {
  Vehicle vehicle = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  for (auto& [name, parameter] : vehicle.parameters) parameter.std = 0.01 * std::abs(parameter.value);
  const auto tells = [&](int rotor_speeds) {
    const std::vector<Asked> all = asked_of("Jxx", vehicle, flight_of(vehicle, rotor_speeds));
    return std::ranges::find(all, "rotor speeds", &Asked::part) != all.end();
  };
  EXPECT_TRUE(tells(1));
  EXPECT_FALSE(tells(0));
}

}  // namespace
}  // namespace ident
