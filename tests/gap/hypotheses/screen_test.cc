// The quadratic form over all causes on simulated flight.
#include "ident/gap/hypotheses/screen.h"

#include <gtest/gtest.h>

#include "ident/flight/make_record.h"
#include "ident/gap/hypotheses/fitted_model.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/sim/simulate.h"

namespace ident {
namespace {

// Gusts that push above the origin turn the vehicle as they move it: the form has an unknown for that height,
// after all others, and finds it.
TEST(Screen, HeightAtWhichGustsPushIsFound) {
  const Vehicle vehicle = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  const std::vector<double> p = parameter_vector(vehicle);
  for (const double arm : {0.0, 0.04, -0.04}) {
    SimulationOptions options;
    options.duration = 25.0;
    options.rate = 100.0;
    options.turbulence = 1.0;
    options.gust_arm = arm;
    const std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
    const FlightRecord record = make_flight_record(vehicle, p, logs);
    const FittedModel base = fitted(free_constants(vehicle, p), {}, record, p, {});
    const ExtendedProblem problem =
        extended_problem(vehicle, base.theta->p(base.fit.u), record.signals, base.constants, {});
    const QuadraticForm form = linearise_everything(record, base.fit, *base.theta, problem);
    ASSERT_EQ(form.S.rows(), form.g.size());
    const double found = kGustArm * payload_reach(vehicle) * gain_of(form, problem, {}).step.tail<1>()[0];
    EXPECT_NEAR(found, arm, 0.015) << "m; to first order about none";
  }
}

}  // namespace
}  // namespace ident
