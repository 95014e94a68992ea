// Forces from outside against those of the stated air.
#include "ident/flight/checks/air_exceeds.h"

#include <gtest/gtest.h>

#include "ident/core/format_number.h"
#include "support/published_hover.h"

namespace ident {
namespace {

GustsExpected expected_of(Vehicle vehicle, std::optional<AirLevel> air) {
  vehicle.air = air;
  FlightRecord record;
  record.vehicle = &vehicle, record.p = parameter_vector(vehicle);
  return gusts_expected(record);
}

// 0.3 1/s across and 0.5 1/s along, per mass: m sqrt(2 (0.3 1.489)^2 + (0.5 0.772)^2) = 0.740 m N.
TEST(GustsExpected, OfAVehicleWithoutDragAreThoseOfAUsualOne) {
  Vehicle vehicle = testing::published_vehicle();
  const GustsExpected light = expected_of(vehicle, {});
  EXPECT_EQ(light.level, AirLevel::light);
  EXPECT_FALSE(light.stated);
  EXPECT_NEAR(light.force, 0.740 * vehicle.value("m"), 2e-3 * vehicle.value("m"));
  EXPECT_TRUE(expected_of(vehicle, AirLevel::light).stated);
}

// Four rotors at Omega_hover: F = -4 kd Omega v across, so 4 kd Omega_hover sigma_u for each gust across.
TEST(GustsExpected, FollowTheDragThatIsStated) {
  Vehicle vehicle = testing::published_vehicle();
  vehicle.parameters["rotor_drag.kd"] = {1e-4, {}};
  const double m = vehicle.value("m"), n = static_cast<double>(vehicle.rotors.size());
  const double Omega = std::sqrt(m * vehicle.g / (n * vehicle.value("kT")));
  const GustsExpected light = expected_of(vehicle, AirLevel::light);
  const GustScale gusts = gusts_of(AirLevel::light);
  const double across = n * 1e-4 * Omega * gusts.horizontal, along = 0.5 * m * gusts.vertical;
  const double force = std::sqrt(2 * across * across + along * along);
  EXPECT_NEAR(light.force, force, 0.05 * force);  // rotors are slanted by a few degrees
}

TEST(AirExceeds, NamesBothForces) {
  const GustsExpected light = expected_of(testing::published_vehicle(), AirLevel::light);
  Result within, beyond;
  warn_of_excess(within, AirBalance{light, 2 * light.force});
  EXPECT_FALSE(within.has_warning("air_exceeds")) << "the drag that nobody stated may be twice as large";
  warn_of_excess(beyond, AirBalance{light, 10 * light.force});
  ASSERT_TRUE(beyond.has_warning("air_exceeds"));
  for (const double newtons : {10 * light.force, light.force})
    EXPECT_NE(beyond.warnings[0].message.find(format_number(newtons, 2) + " N"), std::string::npos)
        << beyond.warnings[0].message;
}

}  // namespace
}  // namespace ident
