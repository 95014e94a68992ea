// The refinement on a recording of others: a brushed Crazyflie without rotor speeds and attitude.
#include <gtest/gtest.h>

#include <algorithm>

#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"
#include "support/real_data.h"

namespace ident {
namespace {

// Commands of the windows that are flown, from the least.
std::vector<double> flown_commands(const std::vector<FlightLog>& logs) {
  std::vector<double> flown;
  for (const FlightLog& log : logs)
    for (std::size_t i = 0; i < log.t.size(); ++i)
      if (std::ranges::any_of(log.windows,
                              [&](const auto& w) { return log.t[i] >= w[0] && log.t[i] <= w[1]; }))
        for (const auto& delta : log.delta) flown.push_back(delta[i]);
  std::ranges::sort(flown);
  return flown;
}

FlightLog arplab_log(const std::string& folder, const Vehicle& vehicle, const std::string& name) {
  const std::string map = std::string(IDENT_SOURCE_DIR) + "/data/maps/arplab_crazyflie_" + name + ".yaml";
  return read_flight_log(folder + "/flight/arplab_crazyflie/" + name + ".csv", vehicle, read_log_map(map));
}

double value_of(const Result& result, const std::string& name) {
  const auto p = std::ranges::find(result.parameters, name, &Parameter::name);
  EXPECT_NE(p, result.parameters.end()) << name;
  return p == result.parameters.end() ? 0.0 : p->value;
}

// Thrust at a command over the published one.
double over_published(const Result& result, double u) {
  const double Omega = value_of(result, "Omega_0") + value_of(result, "km") * u;
  return value_of(result, "kT") * Omega * Omega / (0.02127 - 0.01118 * u + 0.12013 * u * u);
}

// What is known beforehand is vague: a factor of 1.3 off and said to be so. The moments are those of such a
// vehicle as simulators have them, 1.395e-5 and 1.436e-5. Published with the flights (Eschmann, Albani,
// Loianno, Data-Driven System Identification of Quadrotors Subject to Motor Delays) are 1.029e-5
// and 1.105e-5, and so they come out, to 3 %, if motors that are off count as driven: see
// flight_coasting_test.cc.
TEST(RealRefinement, ThreeLogsGiveABrushedCrazyflieAsOthersKnowIt) {
  IDENT_NEEDS_REAL_DATA(folder);
  const Vehicle vehicle = arplab_crazyflie_known_vaguely();
  std::vector<FlightLog> logs;
  for (const char* log : {"log10", "log15", "log16"}) logs.push_back(arplab_log(folder, vehicle, log));
  const Result result = refine_flight(vehicle, logs, {.validate = false});
  EXPECT_TRUE(result.has_warning("not_driven"));
  EXPECT_NEAR(value_of(result, "Jxx"), 1.395e-5, 0.1 * 1.395e-5);
  EXPECT_NEAR(value_of(result, "Jyy"), 1.436e-5, 0.1 * 1.436e-5);
  const double lag = 2 * value_of(result, "zeta_m") / value_of(result, "omega_m");
  EXPECT_GT(lag, 0.06);
  EXPECT_LT(lag, 0.08);
  const std::vector<double> flown = flown_commands(logs);
  for (const double share : {0.1, 0.25, 0.5, 0.75, 0.95}) {
    const double u = flown[static_cast<std::size_t>(share * static_cast<double>(flown.size() - 1))];
    EXPECT_NEAR(over_published(result, u), 1.0, 0.1) << "command " << u;
  }
}

// The one that was flown for it.
TEST(RealRefinement, TheLogOfThrustAloneGivesItsCurveAsPublished) {
  IDENT_NEEDS_REAL_DATA(folder);
  const Vehicle vehicle = arplab_crazyflie_known_vaguely();
  const std::vector<FlightLog> logs = {arplab_log(folder, vehicle, "log10")};
  const Result result = refine_flight(vehicle, logs, {.validate = false});
  const std::vector<double> flown = flown_commands(logs);
  for (const double share : {0.1, 0.25, 0.5, 0.75, 0.95}) {
    const double u = flown[static_cast<std::size_t>(share * static_cast<double>(flown.size() - 1))];
    EXPECT_NEAR(over_published(result, u), 1.0, 0.1) << "command " << u;
  }
  EXPECT_FALSE(result.has_warning("thrust_level"));
}

// A speed proportional to the command leaves a tenth of the weight to a gust that lasts for the whole flight,
// and pulls the mass by eight deviations.
TEST(RealRefinement, ThrustThatDoesNotCarryTheWeightIsTriedWithAnOffset) {
  IDENT_NEEDS_REAL_DATA(folder);
  Vehicle vehicle = crazypad_crazyflie();
  vehicle.parameters.erase("Omega_0");
  vehicle.parameters["m"] = {0.0347, 1e-3};
  const std::string map = std::string(IDENT_SOURCE_DIR) + "/data/maps/nanobench_crazyflie.yaml";
  const FlightLog log =
      read_flight_log(folder + "/flight/nanobench/B2_circle_slow_rep2.csv", vehicle, read_log_map(map));
  const Result result = refine_flight(vehicle, std::span(&log, 1), {.validate = false});
  EXPECT_TRUE(result.has_warning("command_offset"));
  EXPECT_FALSE(result.has_warning("thrust_level"));
  EXPECT_NEAR(value_of(result, "m"), 0.0347, 1.5e-3);  // 0.0309 without
}

}  // namespace
}  // namespace ident
