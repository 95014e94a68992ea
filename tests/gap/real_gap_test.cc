// The diagnosis on recordings of others whose cause is known from how they were made.
#include <gtest/gtest.h>

#include <algorithm>

#include "ident/effects/catalogue.h"
#include "ident/flight/make_record.h"
#include "ident/gap/diagnose.h"
#include "ident/gap/statistics/level_thrust.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"
#include "support/real_data.h"

namespace ident {
namespace {

// A motor stated nearly instant, with confidence. Its lag cannot be reached from there by small steps, which
// end at a strange damping instead.
TEST(RealGap, ANearlyInstantMotorIsTheFirstThingFoundWrongOfABrushedCrazyflie) {
  IDENT_NEEDS_REAL_DATA(folder);
  Vehicle vehicle = arplab_crazyflie();
  const auto state = [&](const char* name, double value, double std) {
    vehicle.parameters[name] = {value, std};
  };
  state("m", 0.027, 3e-4), state("kT", 2.876e-8, 3e-9), state("kQ", 1.2e-10, 6e-11);
  state("km", 1538, 150), state("Omega_0", 558, 100), state("omega_m", 300, 15), state("zeta_m", 1, 0.1);
  state("Jxx", 1.05e-5, 1e-6), state("Jyy", 1.1e-5, 1e-6), state("Jzz", 1.95e-5, 4e-6);
  LogMap map = read_log_map(std::string(IDENT_SOURCE_DIR) + "/data/maps/arplab_crazyflie_log15.yaml");
  map.windows = {{55, 75}};  // of 35 s that fly: enough, at 1 kHz
  const std::vector<FlightLog> logs{
      read_flight_log(folder + "/flight/arplab_crazyflie/log15.csv", vehicle, map)};
  const Diagnosis found = diagnose_gap(vehicle, logs);
  EXPECT_EQ(found.result.extra["search"][0]["adopted"], "parameter:omega_m");
  // Small causes beside it, and constants that the flight contradicts, take nothing from that.
  const auto& verdict = found.result.extra["verdict"];
  EXPECT_EQ(verdict["status"], "identified") << verdict;
  EXPECT_NE(std::ranges::find(verdict["effects"], "parameter:omega_m"), verdict["effects"].end()) << verdict;
  const double omega_m = found.adopted.parameters.at("omega_m").value,
               zeta_m = found.adopted.parameters.at("zeta_m").value;
  EXPECT_NEAR(2 * zeta_m / omega_m, 0.07, 0.015) << "s, the published time constant";
}

// From vague bench values the model misses these flights by far. An accelerometer that is off by a third of g
// would explain them; at rest before the flight it shows 1.00 g. What is wrong is the thrust over commands:
// the published one is no square (data/REAL_FLIGHT.md).
TEST(RealGap, NoCauseIsNamedOfASizeThatNoVehicleHas) {
  IDENT_NEEDS_REAL_DATA(folder);
  const Vehicle vehicle = arplab_crazyflie_known_vaguely();
  const std::vector<FlightLog> logs{read_flight_log(
      folder + "/flight/arplab_crazyflie/log16.csv", vehicle,
      read_log_map(std::string(IDENT_SOURCE_DIR) + "/data/maps/arplab_crazyflie_log16.yaml"))};
  const Judged verdict = diagnose_gap(vehicle, logs).verdict;
  EXPECT_NE(std::ranges::find(verdict.effects, "thrust_curve"), verdict.effects.end()) << verdict.sentence;
  for (const char* of_sensors : {"imu_bias", "imu_lever_arm", "imu_misalignment"})
    EXPECT_EQ(std::ranges::find(verdict.effects, of_sensors), verdict.effects.end()) << verdict.sentence;
}

// The battery of the same kind of vehicle, seen without any model of its motion: the recordings' own
// description has the thrust per squared duty vary by 27 %, and by 7 % with the voltage.
TEST(RealGap, ABatteryShowsInTheThrustOfACrazyflie) {
  IDENT_NEEDS_REAL_DATA(folder);
  Vehicle vehicle = arplab_crazyflie();
  const auto state = [&](const char* name, double value, double std) {
    vehicle.parameters[name] = {value, std};
  };
  state("m", 0.037, 3e-3), state("kT", 2.9e-8, 6e-9), state("kQ", 2e-10, 1e-10), state("km", 2400, 400);
  state("Omega_0", 300, 150), state("omega_m", 30, 10), state("zeta_m", 1, 0.2);
  state("Jxx", 1.6e-5, 6e-6), state("Jyy", 1.6e-5, 6e-6), state("Jzz", 2.9e-5, 1e-5);
  vehicle.battery_voltage = 4.2;
  const LogMap map = read_log_map(std::string(IDENT_SOURCE_DIR) + "/data/maps/nanobench_crazyflie.yaml");
  std::vector<FlightLog> logs;
  for (const char* name : {"B3_figure8_fast_rep1", "B6_linear_ramp_rep3", "B8_star_fast_rep2"})
    logs.push_back(read_flight_log(folder + "/flight/nanobench/" + name + ".csv", vehicle, map));
  const std::vector<double> p = parameter_vector(vehicle);
  const LevelThrust seen = level_thrust(make_flight_record(vehicle, p, logs), p);
  EXPECT_TRUE(seen.plain());
  EXPECT_NEAR(seen.n, 0.7, 0.2);
  EXPECT_LT(seen.left, 0.4 * seen.varies);
}

}  // namespace
}  // namespace ident
