// Speeds that jump by themselves are felt, noise of their sensor is not.
#include "ident/estimators/flight_jitter.h"

#include <gtest/gtest.h>

#include "ident/estimators/flight_refine.h"
#include "support/known_quad.h"

namespace ident {
namespace {

// A log of rates and specific force whose rotors jump off what was simulated in every row, rad/s, as the
// vehicle feels along z and about x and y, and the log shows but for the noise of its sensor.
FlightLog flown(const Vehicle& truth, double jumps, double sensor) {
  FlightLog log = testing::flight(truth, 200, 3, 30);
  log.q_WB = {}, log.v_W = {}, log.x_W = {};
  Random random(8);
  std::array<double, 2> turned{};  // by what jumped before, rad/s
  for (std::size_t i = 0; i < log.t.size(); ++i) {
    double lift = 0;
    std::array<double, 2> moment{};
    for (std::size_t n = 0; n < 4; ++n) {
      const double jump = jumps * random.normal(), Omega = log.Omega[n][i];
      const double more = truth.value("kT") * ((Omega + jump) * (Omega + jump) - Omega * Omega);
      const Eigen::Vector3d& r = truth.rotors[n].r_B;
      lift += more, moment[0] -= r[1] * more, moment[1] += r[0] * more;
      log.Omega[n][i] += jump + sensor * random.normal();
    }
    log.f_B[2][i] -= lift / truth.value("m");
    for (std::size_t k = 0; k < 2; ++k) {
      log.w_B[k][i] += turned[k];
      turned[k] += moment[k] / truth.value(k == 0 ? "Jxx" : "Jyy") * 0.005;
    }
  }
  return log;
}

FeltJitter of(const FlightLog& log) {
  const Vehicle vehicle = testing::known(testing::quad());
  const std::vector<double> p = parameter_vector(vehicle);
  const std::vector<FlightLog> logs{log};
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), record.logs, true);
  return felt_jitter(record, theta, fit_flight(record, theta, {}));
}

TEST(Jitter, OfASensorIsNotFelt) {
  const FeltJitter seen = of(flown(testing::quad(), 0.0, 20.0));
  EXPECT_FALSE(seen.matters()) << seen.share << " +- " << seen.std;
  EXPECT_LT(std::abs(seen.share), 0.2);
  EXPECT_GT(seen.std, 0.0);
  EXPECT_FALSE(of(testing::flight(testing::quad(), 200, 3, 30)).matters());
}

TEST(Jitter, OfRotorsIsFelt) {
  const FeltJitter seen = of(flown(testing::quad(), 20.0, 1.0));
  EXPECT_TRUE(seen.matters()) << seen.share << " +- " << seen.std;
  EXPECT_LT(seen.share, 1.3);
}

TEST(Jitter, ARefinementTakesSpeedsThatAreFeltForItsInput) {
  const std::vector<FlightLog> logs{flown(testing::quad(), 20.0, 1.0)};
  const Result result = refine_flight(testing::known(testing::quad()), logs, {.validate = false});
  EXPECT_TRUE(result.has_warning("speeds_jitter"));
  EXPECT_EQ(result.find("omega_m"), nullptr);
  EXPECT_NEAR(result.find("Jxx")->value / testing::quad().value("Jxx"), 1.0, 0.05);
  EXPECT_NEAR(result.find("kT")->value / testing::quad().value("kT"), 1.0, 0.05);
}

}  // namespace
}  // namespace ident
