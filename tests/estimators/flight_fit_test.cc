// The noise that a fit finds: the sensors' once, the air's for each log.
#include "ident/estimators/flight_fit.h"

#include <gtest/gtest.h>

#include "ident/io/vehicle_file.h"
#include "ident/model/simulate.h"

namespace ident {
namespace {

TEST(FlightFit, ACalmLogIsNotTakenForAGustyOne) {
  const Vehicle vehicle = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  SimulationOptions options;
  options.duration = 20.0;
  options.rate = 100.0;
  std::vector<FlightLog> logs;
  for (const double gusts : {0.5, 0.0}) {
    options.turbulence = gusts;
    options.seed += 1;
    logs.push_back(simulate_flight(vehicle, options).log);
  }
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), record.logs, true);
  const NoiseModel noise = fit_flight(record, theta).noise;
  ASSERT_EQ(noise.air.size(), 2u);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LT(noise.air[1].v_dot[k].sigma, 0.2 * noise.air[0].v_dot[k].sigma);
  EXPECT_GT(noise.air[0].v_dot[0].sigma, 0.0);
}

}  // namespace
}  // namespace ident
