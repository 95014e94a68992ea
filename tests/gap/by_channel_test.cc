// What the channels ask of a cause found: the same where it is the true one.
#include "ident/gap/by_channel.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ident/io/vehicle_file.h"
#include "ident/model/simulate.h"

namespace ident {
namespace {

FlightLog flight_of(const Vehicle& vehicle) {
  SimulationOptions options;
  options.duration = 20.0;
  options.rate = 100.0;
  options.seed = 3;
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

}  // namespace
}  // namespace ident
