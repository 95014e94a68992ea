// Motors of which only the lag can be told.
#include "ident/flight/fit/first_order_motors.h"

#include <gtest/gtest.h>

#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "support/known_quad.h"

namespace ident {
namespace {

constexpr double kLag = 0.045;  // s

Vehicle with_motors(double omega_m, double zeta_m) {
  Vehicle v = testing::quad();
  v.parameters["omega_m"].value = omega_m, v.parameters["zeta_m"].value = zeta_m;
  return v;
}

/// Nobody stated anything of the motors but the dead time.
Vehicle without_motors(Vehicle v) {
  v = testing::known(std::move(v));
  v.parameters.erase("omega_m"), v.parameters.erase("zeta_m");
  return v;
}

TEST(FirstOrder, TheLagIsIdentifiedAndStored) {
  const Vehicle vehicle = with_motors(2 * 60.0 / kLag, 60.0);
  const std::vector<FlightLog> logs{testing::flight(vehicle, 250, 3, 30)};
  const Result result = refine_flight(without_motors(vehicle), logs, {.validate = false});
  EXPECT_TRUE(result.has_warning("first_order_motors"));
  const Parameter &omega_m = *result.find("omega_m"), &zeta_m = *result.find("zeta_m");
  EXPECT_NEAR(zeta_m.value, 50, 1);
  EXPECT_FALSE(zeta_m.prior_value) << "nobody stated it";
  EXPECT_TRUE(omega_m.identifiable);
  const Vehicle stored = with_result({}, result);
  EXPECT_NEAR(2 * stored.value("zeta_m") / stored.value("omega_m") / kLag, 1.0, 0.005);
  EXPECT_GT(stored.correlation.of("omega_m", "zeta_m"), 0.9);
  EXPECT_NEAR(result.find("Jxx")->value / vehicle.value("Jxx"), 1.0, 0.01);
}

TEST(FirstOrder, IsNotAssumedForMotorsOfSecondOrder) {
  const std::vector<FlightLog> logs{testing::flight(testing::quad(), 250, 3, 30)};
  const Result result = refine_flight(without_motors(testing::quad()), logs, {.validate = false});
  EXPECT_FALSE(result.has_warning("first_order_motors"));
  EXPECT_NEAR(result.find("zeta_m")->value, 0.8, 0.02);
}

TEST(FirstOrder, IsNotTestedWhereTheMotorsAreStated) {
  const Vehicle vehicle = with_motors(2 * 60.0 / kLag, 60.0);
  const std::vector<FlightLog> logs{testing::flight(vehicle, 250, 3, 30)};
  const Result result = refine_flight(testing::known(vehicle), logs, {.validate = false});
  EXPECT_FALSE(result.has_warning("first_order_motors"));
  EXPECT_NEAR(2 * result.find("zeta_m")->value / result.find("omega_m")->value / kLag, 1.0, 0.01);
}

}  // namespace
}  // namespace ident
