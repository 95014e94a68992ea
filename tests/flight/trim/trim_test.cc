// The balance of the rotors: what flights without rates and attitude tell.
#include "ident/flight/trim/trim.h"

#include <gtest/gtest.h>

#include <numeric>

#include "ident/core/error.h"
#include "ident/flight/make_record.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/flight/verify.h"
#include "ident/io/log/read_flight_log.h"
#include "support/path_only.h"
#include "support/real_data.h"

namespace ident {
namespace {

using testing::path_only;
using testing::with_ratios;
using Ratios = std::vector<double>;

double ratio(const Result& result, std::size_t rotor) {
  return result.find("rotor_mismatch.ratio@" + std::to_string(rotor + 1))->value;
}

Ratios about_their_mean(Ratios ratios) {
  const double mean = std::accumulate(ratios.begin(), ratios.end(), 0.0) / static_cast<double>(ratios.size());
  for (double& r : ratios) r += 1 - mean;
  return ratios;
}

TEST(FlightTrim, UnequalRotorsAreFoundFromCommandsAndPath) {
  const Vehicle stated = testing::upright();
  const Ratios truth = about_their_mean({0.93, 1.04, 0.98, 1.05});
  for (const bool velocity : {true, false}) {
    const std::vector<FlightLog> logs{
        path_only(with_ratios(stated, truth), 1, {.noise = "none", .velocity = velocity})};
    const Result result = refine_flight(stated, logs);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(ratio(result, k), truth[k], 0.012) << k;  // some of it may be scatter
    EXPECT_TRUE(result.has_warning("no_turning"));
    EXPECT_TRUE(result.has_warning("one_flight"));
    EXPECT_TRUE(result.find("rotor_mismatch.ratio@1")->identifiable);
    EXPECT_FALSE(result.find("Jxx")->identifiable);
    EXPECT_EQ(result.find("omega_m")->value, stated.value("omega_m"));
    EXPECT_NEAR(result.find("kQ")->value / stated.value("kQ"), 1, 1e-6) << "balance says nothing of it";
  }
}

TEST(FlightTrim, WithTheRotorsAsTheyAreEverythingBalances) {
  const Vehicle truth = with_ratios(testing::upright(), {0.9, 1.04, 0.96, 1.1});
  const std::vector<FlightLog> logs{path_only(truth, 3, {.seconds = 40.0, .noise = "none"})};
  const std::vector<double> p = parameter_vector(truth);
  const FlightRecord record = make_flight_record(truth, p, logs);
  const Trim trim = make_trim(record, p);
  const Eigen::VectorXd y = unbalance(record, trim, p);
  const Eigen::Map<const Eigen::MatrixXd> by_channel(y.data(), kTrimChannels, y.size() / kTrimChannels);
  EXPECT_LT(by_channel.rowwise().mean().cwiseAbs().maxCoeff(), 2e-3) << by_channel.rowwise().mean();
}

// Noise of the path makes every acceleration look larger than it is.
TEST(FlightTrim, NoiseOfThePathDoesNotBiasThrust) {
  const Vehicle truth = testing::upright();
  FlightLog log = path_only(truth, 3, {.seconds = 40.0, .noise = "none", .velocity = false});
  Random random(1);
  for (std::vector<double>& axis : log.x_W)
    for (double& x : axis) x += 0.015 * random.normal();
  const std::vector<double> p = parameter_vector(truth);
  const std::vector<FlightLog> logs{log};
  const FlightRecord record = make_flight_record(truth, p, logs);
  const Eigen::VectorXd y = unbalance(record, make_trim(record, p), p);
  const Eigen::Map<const Eigen::MatrixXd> by_channel(y.data(), kTrimChannels, y.size() / kTrimChannels);
  EXPECT_NEAR(by_channel.row(0).mean(), 0.0, 4e-3);
}

TEST(FlightTrim, ThrustForACommandIsFoundAsWhole) {
  Vehicle stated = testing::upright();
  const Vehicle truth = stated;
  stated.parameters.at("kT") = {1.2 * truth.value("kT"), 0.24 * truth.value("kT")};
  stated.parameters.at("km").std = 0.0, stated.parameters.at("m").std = 0.0;
  for (const char* scenario : {"hover", "mixed"}) {
    const std::vector<FlightLog> logs{path_only(truth, 2, {.seconds = 30.0, .scenario = scenario})};
    EXPECT_NEAR(refine_flight(stated, logs).find("kT")->value / truth.value("kT"), 1.0, 0.02) << scenario;
  }
}

// Each flight's rotors scatter; three flights give intervals for a fourth.
TEST(FlightTrim, IntervalsHoldTheRotorsOfTheNextFlight) {
  const Vehicle stated = testing::upright();
  constexpr int kDraws = 25;
  Random random(11);
  int inside = 0;
  double width = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Ratios own(4);
    for (double& r : own) r = 1 + 0.06 * random.normal();
    const auto flown = [&] {
      Ratios now = own;
      for (double& r : now) r += 0.02 * random.normal();
      return about_their_mean(now);
    };
    std::vector<FlightLog> logs;
    for (int log = 0; log < 3; ++log)
      logs.push_back(path_only(with_ratios(stated, flown()), static_cast<std::uint64_t>(10 * draw + log + 1),
                               {.seconds = 12.0}));
    const Result result = refine_flight(stated, logs);
    const Ratios next = flown();
    for (std::size_t k = 0; k < 4; ++k) {
      const Parameter* found = result.find("rotor_mismatch.ratio@" + std::to_string(k + 1));
      inside += found->ci95[0] < next[k] && next[k] < found->ci95[1] ? 1 : 0;
      width += found->std / (4 * kDraws);
    }
  }
  EXPECT_GE(inside, 89) << "of 100, 95 expected";
  EXPECT_LT(width, 0.035) << "0.02 sqrt(4/3) if the scatter were known";
}

TEST(FlightTrim, AVeryShortFlightIsRefused) {
  const Vehicle stated = testing::upright();
  const std::vector<FlightLog> logs{path_only(stated, 1, {.seconds = 4.0})};
  EXPECT_THROW(refine_flight(stated, logs), DataError);
}

TEST(FlightTrim, VerificationReportsTheBalanceOfTheStatedModel) {
  const Vehicle stated = testing::upright();
  const std::vector<FlightLog> logs{path_only(with_ratios(stated, {0.9, 1, 1.1, 1}), 1)};
  const Result result = verify_flight(stated, logs);
  EXPECT_LT(result.fit["unbalance"]["thrust"].get<double>(), 0.02);
  const double expected = (1 / 0.9 - 1 / 1.1) / (4 * std::sqrt(2.0));  // of rotors 1 and 3, on a diagonal
  EXPECT_NEAR(result.fit["unbalance"]["Mx"].get<double>(), expected, 0.004);
  EXPECT_NEAR(result.fit["unbalance"]["My"].get<double>(), expected, 0.004);
  EXPECT_LT(result.fit["unbalance"]["Mz"].get<double>(), 0.002);
}

// Normal flights of one Crazyflie: what its third rotor is told to do differs from the others by the same in
// each.
TEST(FlightTrim, ACrazyflieWithoutGyroHasRotorsOfItsOwn) {
  IDENT_NEEDS_REAL_DATA(folder);
  const Vehicle vehicle = crazypad_crazyflie();
  std::vector<FlightLog> logs;
  for (const char* name : {"00", "02", "03"})
    logs.push_back(crazypad_flight(folder, std::string("m_normal_flight__E9_log") + name, vehicle));
  const Result result = refine_flight(vehicle, logs);
  const Parameter* third = result.find("rotor_mismatch.ratio@3");
  EXPECT_NEAR(third->value, 0.91, 0.02);  // its share of the squared speeds in hover is 1.13 to 1.15
  EXPECT_LT(third->std, 0.05);
  EXPECT_NEAR(result.fit["rotor_scatter"].get<double>(), 0.03, 0.015);
}

}  // namespace
}  // namespace ident
