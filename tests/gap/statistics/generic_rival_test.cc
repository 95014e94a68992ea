// What a regression predicts beyond a model: nothing where the model is right, and what motors do where it is
// not.
#include "ident/gap/statistics/generic_rival.h"

#include <gtest/gtest.h>

#include "ident/flight/fit/fit.h"
#include "ident/flight/make_record.h"
#include "support/published_hover.h"

namespace ident {
namespace {

// Gains beside a fitted model that takes `truth` for the published vehicle with bench values that are off.
Rival rival_of(const Vehicle& truth) {
  SimulationOptions options;
  options.duration = 30.0, options.rate = 250.0, options.seed = 5;
  options.noise.rotor_speed = 0.005;
  const std::vector<FlightLog> logs{simulate_flight(truth, options).log};
  Vehicle model = testing::published_vehicle();
  for (const auto& [name, off] : {std::pair{"km", 1.01}, {"omega_m", 1.1}, {"kT", 0.98}})
    model.parameters[name] = {off * model.value(name), 0.1 * model.value(name)};
  const std::vector<double> p = parameter_vector(model);
  const FlightRecord record = make_flight_record(model, p, logs);
  const Theta theta(p, free_constants(model, p), 1, true);
  const FlightFit fit = fit_flight(record, theta);
  return generic_rival(record, theta, fit, fit.noise);
}

double gain_in(const Rival& rival, const std::string& channel) {
  const auto at = std::ranges::find(rival.sensors, channel, &std::pair<std::string, double>::first);
  return at == rival.sensors.end() ? kNaN : at->second;
}

// Speeds measured with noise must not stand on both sides of the regression, nor what bench values are off.
TEST(GenericRival, SeesNothingBesideARightModelFromWrongBenchValues) {
  const Rival rival = rival_of(testing::published_vehicle());
  EXPECT_LT(gain_in(rival, "motors"), 10.0);
  EXPECT_LT(rival.total(), 30.0);
}

TEST(GenericRival, SeesInTheRotorsSpeedsThatMotorsSlowDownMoreSlowly) {
  Vehicle truth = testing::published_vehicle();
  truth.parameters["motor_asymmetry.ratio"] = {0.7, {}};
  const Rival rival = rival_of(truth);
  EXPECT_GT(gain_in(rival, "motors"), 60.0);
}

}  // namespace
}  // namespace ident
