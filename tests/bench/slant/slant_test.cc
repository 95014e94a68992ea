// Slant angle: closed form, optimum for unequal rotors, allocation, uncertainty.
#include "ident/bench/slant/slant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "ident/bench/slant/slant_allocation.h"
#include "ident/bench/slant/slant_optimum.h"
#include "ident/bench/slant/slant_tables.h"
#include "ident/core/error.h"
#include "support/run_program.h"

namespace ident {
namespace {

Vehicle slanted_vehicle(double kT, double kQ, double l) {
  Vehicle v;
  v.layout = "4sp";
  v.arm = l;
  v.rotors = layout_rotors("4sp", l, 0.0);
  v.parameters = {{"kT", {kT, 0.01 * kT}}, {"kQ", {kQ, 0.02 * kQ}}};
  return v;
}

TEST(Slant, BestAngleOfEqualRotorsIsTheClosedForm) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log_kT(-16, -10), lever(0.003, 0.03), arm(0.03, 0.5);
  for (int i = 0; i < 100; ++i) {
    const double kT = std::exp(log_kT(random)), l = arm(random), kQ = lever(random) * kT;
    EXPECT_NEAR(best_slant(slanted_vehicle(kT, kQ, l), l), std::atan(2 * kQ / (l * kT)), 1e-9);
  }
}

// [Phang, Theorem 4.1]: at that angle heave, pitch, roll and yaw inputs give pure moments.
TEST(Slant, MomentsDecoupleAndTheForceOfRollDoesNot) {
  const double kT = 6e-6, kQ = 5.15e-8, l = 0.17, alpha = std::atan(2 * kQ / (l * kT));
  const Eigen::Matrix<double, 6, 4> B = input_allocation(slanted_vehicle(kT, kQ, l), alpha);
  Eigen::Matrix<double, 6, 4> expected = Eigen::Matrix<double, 6, 4>::Zero();
  expected(2, 0) = -4;                                   // heave: 4 t upwards, z is down
  expected(3, 1) = 2 * (l + kQ / kT * std::tan(alpha));  // roll
  expected(0, 1) = -2 * std::tan(alpha);                 // and its sideways push, model README erratum 3
  expected(4, 2) = 2 * l;                                // pitch
  expected(5, 3) = 4 * kQ / kT;                          // yaw: as much as a conventional quadrotor has
  EXPECT_LT((B - expected).norm(), 1e-12) << B;
}

// [Phang] Table II: 0.202 t at 5.77 deg.
TEST(Slant, SidewaysForceOfPhangsVehicleIsAFifthOfTheRollInput) {
  const double alpha = 5.77 * M_PI / 180;
  EXPECT_NEAR(input_allocation(slanted_vehicle(6e-6, 5.15e-8, 0.17), alpha)(0, 1), -0.202, 5e-4);
}

TEST(Slant, BestAngleOfUnequalRotorsIsTheMinimum) {
  Vehicle v = slanted_vehicle(6e-6, 6e-8, 0.17);
  v.parameters["rotor_mismatch.ratio@2"] = {0.85, {}};
  v.rotors[0].r_B *= 1.2;
  v.rotors[3].r_B *= 0.9;
  const double best = best_slant(v, 0.17);
  EXPECT_GT(std::fabs(best - optimal_slant(6e-6, 6e-8, 0.17)), 1e-3);
  for (int i = 0; i <= 4000; ++i)
    EXPECT_LE(unwanted_moment(v, 0.17, best), unwanted_moment(v, 0.17, 1e-4 * i) + 1e-15);
}

TEST(Slant, RotorsThatTurnClockwiseLeanTheOtherWay) {
  Vehicle v = slanted_vehicle(6e-6, 6e-8, 0.17);
  for (Rotor& rotor : v.rotors) rotor.s = -1, rotor.slant_B.setZero(), rotor.a_B = {0, 0, -1};
  v.rotors = with_slant_directions(v.rotors);
  EXPECT_GT(v.rotors[1].slant_B.x(), 0.0);
  EXPECT_NEAR(best_slant(v, 0.17), std::atan(2 * 6e-8 / (0.17 * 6e-6)), 1e-12);
}

TEST(Slant, StandardDeviationIsThatOfSampledConstants) {
  const Known kT{6e-6, 1.2e-7}, kQ{5e-8, 1e-9}, l{0.17, 0.001};
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (const double rho : {0.0, 0.8}) {
    double sum = 0, square = 0;
    constexpr int n = 40000;
    for (int i = 0; i < n; ++i) {
      const double a = normal(random), b = rho * a + std::sqrt(1 - rho * rho) * normal(random);
      const double alpha =
          optimal_slant(kT.value + *kT.std * a, kQ.value + *kQ.std * b, l.value + *l.std * normal(random));
      sum += alpha, square += alpha * alpha;
    }
    const double sampled = std::sqrt(square / n - sum / n * (sum / n));
    EXPECT_NEAR(optimal_slant_std(kT, kQ, l, rho) / sampled, 1.0, 0.02) << rho;
  }
}

// A flight knows kQ/kT better than either.
TEST(Slant, ConstantsThatAreKnownTogetherTellTheAngleBetter) {
  Vehicle v = slanted_vehicle(6e-6, 5.15e-8, 0.17);
  const auto relative = [&] {
    const Parameter alpha = estimate_slant(v).parameters.front();
    return alpha.std * 2 / std::sin(2 * alpha.value);
  };
  EXPECT_NEAR(relative(), std::hypot(0.01, 0.02), 1e-12);
  v.correlation = {{"kT", "kQ"}, Eigen::Matrix2d{{1, 0.99}, {0.99, 1}}};
  EXPECT_NEAR(relative(), std::sqrt(0.01 * 0.01 + 0.02 * 0.02 - 2 * 0.99 * 0.01 * 0.02), 1e-12);
}

// Yaw leak 4 kQ/kT - 2 l tan(a + e), authority 2 l tan(a + e): the ratio is 1 - tan(a)/tan(a + e).
TEST(Slant, UprightRotorsThatTurnAlikeHaveNoYawInputAndNoInfiniteNumber) {
  Vehicle vehicle = slanted_vehicle(6e-6, 5.15e-8, 0.17);
  vehicle.parameters["alpha"] = {0.0, {}};
  const Result result = estimate_slant(vehicle);
  ASSERT_TRUE(result.has_warning("slant_not_optimal"));
  for (const Warning& warning : result.warnings)
    EXPECT_EQ(warning.message.find("inf"), std::string::npos) << warning.message;
  EXPECT_EQ(result.extra["alpha_numerical"]["unwanted_moment"], 0.0);
}

TEST(Slant, ADegreeOfMountingErrorCostsYawAsDerived) {
  const Vehicle v = slanted_vehicle(6e-6, 5.15e-8, 0.17);
  const double a = optimal_slant(6e-6, 5.15e-8, 0.17), e = M_PI / 180;
  EXPECT_NEAR(mounting_trim(v, 0.17, a, e), 1 - std::tan(a) / std::tan(a + e), 1e-12);
}

TEST(Slant, NumbersAreInTheResult) {
  const Vehicle v = slanted_vehicle(6e-6, 5.15e-8, 0.17);
  const Result result = estimate_slant(v);
  const Parameter* alpha = result.find("alpha_opt");
  ASSERT_NE(alpha, nullptr);
  EXPECT_NEAR(alpha->value, std::atan(2 * 5.15e-8 / (0.17 * 6e-6)), 1e-15);
  EXPECT_LT(alpha->ci95[0], alpha->value);
  EXPECT_GT(alpha->ci95[1], alpha->value);
  EXPECT_NEAR(alpha->ci95[1] - alpha->ci95[0], 2 * 1.96 * alpha->std, 0.01 * alpha->std);
  EXPECT_NEAR(result.extra["allocation"]["roll"]["Fx"].get<double>(), -2 * std::tan(alpha->value), 1e-12);
  EXPECT_NEAR(result.extra["price"]["lift"].get<double>(), 1 / std::cos(alpha->value), 1e-12);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(Slant, AConventionalQuadrotorIsToldThatItNeedsNone) {
  Vehicle v = slanted_vehicle(6e-6, 6e-8, 0.17);
  v.rotors = layout_rotors("plus", 0.17, 0.0);
  EXPECT_TRUE(estimate_slant(v).has_warning("not_4sp"));
}

TEST(Slant, AMissingConstantIsNamed) {
  Vehicle v = slanted_vehicle(6e-6, 6e-8, 0.17);
  v.file = "v.yaml";
  v.parameters.erase("kQ");
  try {
    estimate_slant(v);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("v.yaml: parameters.kQ: is missing"), std::string::npos)
        << error.what();
  }
}

TEST(SlantProgram, PublishedVehicleHasItsPublishedAngle) {
  const ProgramRun run = run_ident(
      {"slant", "--vehicle", std::string(IDENT_SOURCE_DIR) + "/data/published/phang_4sp.yaml", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_NEAR(json["parameters"]["alpha_opt"]["value"].get<double>() * 180 / M_PI, 5.77, 0.005);
  EXPECT_TRUE(json["parameters"]["alpha_opt"]["std"].is_null());
  EXPECT_NEAR(json["mounted"]["yaw_trim"].get<double>(), 0.0, 1e-3);
}

TEST(SlantProgram, WithoutVehicleOrConstantsItSaysWhatIsMissing) {
  EXPECT_EQ(run_ident({"slant"}, test_folder()).status, 2);
  const std::string file = write_text(test_folder(), "v.yaml", "arm: 0.17\nparameters: {kT: 6e-6}\n");
  const ProgramRun run = run_ident({"slant", "--vehicle", file});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("kQ"), std::string::npos) << run.err;
  EXPECT_EQ(run.out, "");
}

TEST(SlantProgram, StoresTheAngleInTheCampaign) {
  const std::string folder = test_folder();
  write_text(folder, "v.yaml",
             "mass: 0.5\nlayout: 4sp\narm: 0.17\n"
             "parameters: {kT: {value: 6e-6, std: 2e-8}, kQ: {value: 5e-8, std: 4e-10}}\n");
  write_text(folder, "ident.yaml", "vehicle: v.yaml\nparameters: found.yaml\n");
  ASSERT_EQ(run_ident({"slant"}, folder).status, 0);
  const ProgramRun check = run_ident({"slant", "--params", "found.yaml"}, folder);
  EXPECT_EQ(check.status, 2);  // holds the angle alone
  EXPECT_NE(run_ident({"report", "--vehicle", "found.yaml"}, folder).out.find("alpha_opt"),
            std::string::npos);
}

}  // namespace
}  // namespace ident
