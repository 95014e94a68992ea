// The refinement on a recording of others: a brushed Crazyflie without rotor speeds and attitude.
#include <gtest/gtest.h>

#include <algorithm>

#include "ident/estimators/flight_refine.h"
#include "ident/io/read_flight_log.h"
#include "support/real_data.h"

namespace ident {
namespace {

// What is known beforehand is vague: a factor of 1.3 off and said to be so. Published: Eschmann, Albani,
// Loianno, Data-Driven System Identification of Quadrotors Subject to Motor Delays.
TEST(RealRefinement, ThreeLogsGiveABrushedCrazyflieAsPublished) {
  IDENT_NEEDS_REAL_DATA(folder);
  const Vehicle vehicle = arplab_crazyflie_known_vaguely();
  std::vector<FlightLog> logs;
  std::vector<double> flown;
  for (const char* log : {"log10", "log15", "log16"}) {
    const std::string map = std::string(IDENT_SOURCE_DIR) + "/data/maps/arplab_crazyflie_" + log + ".yaml";
    logs.push_back(
        read_flight_log(folder + "/flight/arplab_crazyflie/" + log + ".csv", vehicle, read_log_map(map)));
    for (std::size_t i = 0; i < logs.back().t.size(); ++i)
      if (std::ranges::any_of(logs.back().windows, [&](const auto& w) {
            return logs.back().t[i] >= w[0] && logs.back().t[i] <= w[1];
          }))
        for (const auto& delta : logs.back().delta) flown.push_back(delta[i]);
  }
  const Result result = refine_flight(vehicle, logs, {.validate = false});
  const auto found = [&](const std::string& name) {
    const auto p = std::ranges::find(result.parameters, name, &Parameter::name);
    EXPECT_NE(p, result.parameters.end()) << name;
    return p == result.parameters.end() ? 0.0 : p->value;
  };
  EXPECT_NEAR(found("Jxx"), 1.029e-5, 0.05 * 1.029e-5);
  EXPECT_NEAR(found("Jyy"), 1.105e-5, 0.05 * 1.105e-5);
  const double lag = 2 * found("zeta_m") / found("omega_m");
  EXPECT_GT(lag, 0.06);
  EXPECT_LT(lag, 0.08);
  std::ranges::sort(flown);
  for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95}) {
    const double u = flown[static_cast<std::size_t>(share * static_cast<double>(flown.size() - 1))];
    const double Omega = found("Omega_0") + found("km") * u;
    const double published = 0.02127 - 0.01118 * u + 0.12013 * u * u;
    EXPECT_NEAR(found("kT") * Omega * Omega / published, 1.0, 0.105) << "command " << u;  // 0.101 at 0.57
  }
}

}  // namespace
}  // namespace ident
