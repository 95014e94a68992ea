// The diagnosis on recordings of others whose cause is known from how they were made.
#include <gtest/gtest.h>

#include <algorithm>

#include "ident/gap/diagnose.h"
#include "ident/io/read_flight_log.h"
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
  const std::vector<FlightLog> logs{read_flight_log(
      folder + "/flight/arplab_crazyflie/log15.csv", vehicle,
      read_log_map(std::string(IDENT_SOURCE_DIR) + "/data/maps/arplab_crazyflie_log15.yaml"))};
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

}  // namespace
}  // namespace ident
