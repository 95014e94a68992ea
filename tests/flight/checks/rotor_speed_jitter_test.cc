// Speeds that jump by themselves are felt, noise of their sensor is not.
#include "ident/flight/checks/rotor_speed_jitter.h"

#include <gtest/gtest.h>

#include "ident/flight/make_record.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "support/jumping_speeds.h"

namespace ident {
namespace {

FeltJitter of(const FlightLog& log) {
  const Vehicle vehicle = testing::known(testing::quad());
  const std::vector<double> p = parameter_vector(vehicle);
  const std::vector<FlightLog> logs{log};
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), record.logs, true);
  return felt_jitter(record, theta, fit_flight(record, theta, {}));
}

TEST(Jitter, OfASensorIsNotFelt) {
  const FeltJitter seen = of(testing::with_jumping_speeds(testing::quad(), 0.0, 20.0));
  EXPECT_FALSE(seen.matters()) << seen.share << " +- " << seen.std;
  EXPECT_LT(std::abs(seen.share), 0.2);
  EXPECT_GT(seen.std, 0.0);
  EXPECT_FALSE(of(testing::flight(testing::quad(), 200, 3, 30)).matters());
}

TEST(Jitter, OfRotorsIsFelt) {
  const FeltJitter seen = of(testing::with_jumping_speeds(testing::quad(), 20.0, 1.0));
  EXPECT_TRUE(seen.matters()) << seen.share << " +- " << seen.std;
  EXPECT_LT(seen.share, 1.3);
}

TEST(Jitter, ARefinementTakesSpeedsThatAreFeltForItsInput) {
  const std::vector<FlightLog> logs{testing::with_jumping_speeds(testing::quad(), 20.0, 1.0)};
  const Result result = refine_flight(testing::known(testing::quad()), logs, {.validate = false});
  EXPECT_TRUE(result.has_warning("speeds_jitter"));
  EXPECT_EQ(result.find("omega_m"), nullptr);
  EXPECT_NEAR(result.find("Jxx")->value / testing::quad().value("Jxx"), 1.0, 0.05);
  EXPECT_NEAR(result.find("kT")->value / testing::quad().value("kT"), 1.0, 0.05);
}

}  // namespace
}  // namespace ident
