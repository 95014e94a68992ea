// Real flights: the constants of a brushed Crazyflie against what its owners published.
#include <gtest/gtest.h>

#include <algorithm>

#include "ident/estimators/flight_refine.h"
#include "ident/estimators/statistics.h"
#include "ident/io/read_flight_log.h"
#include "support/real_data.h"

namespace ident {
namespace {

/// Geometry as published with the recordings; everything else is only roughly known.
Vehicle crazyflie() {
  Vehicle v;
  v.name = "crazyflie";
  constexpr std::array<std::array<int, 3>, 4> places = {{{1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, -1}}};
  for (const auto& [x, y, s] : places) {
    Rotor rotor;
    rotor.r_B = {0.028 * x, 0.028 * y, 0.0};
    rotor.s = s;
    v.rotors.push_back(rotor);
  }
  v.parameters = {{"m", {0.027, 0.0003}},  {"kT", {2e-8, 1e-8}},    {"kQ", {1.2e-10, 1.2e-10}},
                  {"km", {2400, 500}},     {"omega_m", {30, 30}},   {"zeta_m", {1, 0.5}},
                  {"Jxx", {1.4e-5, 7e-6}}, {"Jyy", {1.4e-5, 7e-6}}, {"Jzz", {2.2e-5, 1.1e-5}}};
  return v;
}

double value(const Result& r, const std::string& name, double otherwise) {
  const Parameter* p = r.find(name);
  return p ? p->value : otherwise;
}

// Published (Eschmann, Albani, Loianno): motor time constant about 0.07 s, Ixx 1.0286e-5, Iyy 1.1052e-5 kg
// m^2, thrust of a rotor 0.02127 - 0.01118 u + 0.12013 u^2 N.
TEST(FlightReal, TheCrazyflieOfTheArpLabIsAsPublished) {
  IDENT_NEEDS_REAL_DATA(folder);
  const Vehicle vehicle = crazyflie();
  std::vector<FlightLog> logs;
  for (const char* log : {"log10", "log15", "log16"})
    logs.push_back(read_flight_log(
        folder + "/flight/arplab_crazyflie/" + log + ".csv", vehicle,
        read_log_map(std::string(IDENT_SOURCE_DIR) + "/data/maps/arplab_crazyflie_" + log + ".yaml")));
  const Result result = refine_flight(vehicle, logs, {.validate = false});
  const double lag = 2 * result.find("zeta_m")->value / result.find("omega_m")->value;
  EXPECT_GT(lag, 0.06);
  EXPECT_LT(lag, 0.08);
  EXPECT_NEAR(result.find("Jxx")->value / 1.0286e-5, 1.0, 0.05);
  EXPECT_NEAR(result.find("Jyy")->value / 1.1052e-5, 1.0, 0.05);

  std::vector<double> flown;
  for (const FlightLog& log : logs)
    for (std::size_t i = 0; i < log.rows(); ++i)
      for (const auto& window : log.windows)
        if (log.t[i] >= window[0] && log.t[i] <= window[1])
          for (const auto& column : log.delta)
            if (std::isfinite(column[i])) flown.push_back(column[i]);
  const double low = quantile(flown, 0.05), high = quantile(flown, 0.95);
  for (int i = 0; i <= 10; ++i) {
    const double u = low + (high - low) * i / 10;
    const double speed = value(result, "Omega_0", 0.0) + value(result, "km", 0.0) * u;
    EXPECT_NEAR(value(result, "kT", 0.0) * speed * speed / (0.02127 - 0.01118 * u + 0.12013 * u * u), 1.0,
                0.10)
        << u;
  }

  // No rotor speed: the motor's gain cannot be told from kT and kQ.
  EXPECT_FALSE(result.find("km")->identifiable);
  EXPECT_FALSE(result.find("kT")->identifiable);
  const auto named = std::ranges::find(result.warnings, "not_identifiable", &Warning::code);
  ASSERT_NE(named, result.warnings.end());
  for (const char* name : {"kT", "km"})
    EXPECT_NE(named->message.find(name), std::string::npos) << named->message;
}

}  // namespace
}  // namespace ident
