// Samples for domain randomisation: their moments are those of what is known, and every one is a body.
#include "ident/io/simulators/samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "ident/core/error.h"
#include "ident/io/simulators/simulators.h"
#include "io/simulators/simulator_vehicles.h"

namespace ident {
namespace {

constexpr std::size_t kCount = 20000;

TEST(Samples, HaveTheMeanDeviationAndCorrelationOfTheVehicle) {
  const Vehicle v = test::plain_quadrotor();
  double m = 0, mm = 0, k = 0, kk = 0, mk = 0;
  for (const Vehicle& drawn : sampled_vehicles(v, kCount, 7)) {
    const double a = std::log(drawn.value("m") / 0.7) / (0.002 / 0.7),
                 b = std::log(drawn.value("kT") / 6.1e-6) / (1e-7 / 6.1e-6);
    m += a, mm += a * a, k += b, kk += b * b, mk += a * b;
  }
  // Standard normal with correlation 0.6: four standard errors are 0.028 of a mean, 0.04 of a variance, 0.033
  // of the product.
  EXPECT_NEAR(m / kCount, 0.0, 0.03);
  EXPECT_NEAR(k / kCount, 0.0, 0.03);
  EXPECT_NEAR(mm / kCount, 1.0, 0.04);
  EXPECT_NEAR(kk / kCount, 1.0, 0.04);
  EXPECT_NEAR(mk / kCount, 0.6, 0.035);
}

TEST(Samples, AreBodiesEvenWhereTheInertiaIsHardlyKnown) {
  Vehicle v = test::plain_quadrotor();
  for (const char* name : {"Jxx", "Jyy", "Jzz"}) v.parameters[name].std = 0.5 * v.value(name);
  for (const Vehicle& drawn : sampled_vehicles(v, 500, 3)) {
    const double x = drawn.value("Jxx"), y = drawn.value("Jyy"), z = drawn.value("Jzz");
    EXPECT_TRUE(x > 0 && y > 0 && z > 0 && x + y >= z && y + z >= x && z + x >= y);
  }
}

TEST(Samples, AreTheSameForTheSameSeed) {
  const SimulatorFormat& format = find_simulator("rotorpy");
  const Vehicle v = test::plain_quadrotor();
  const std::string first = samples_csv(format, sampled_vehicles(v, 3, 11), 11);
  EXPECT_EQ(first, samples_csv(format, sampled_vehicles(v, 3, 11), 11));
  EXPECT_NE(first, samples_csv(format, sampled_vehicles(v, 3, 12), 11));
  EXPECT_NE(first.find("mass,Ixx,Iyy,Izz,k_eta,k_m,"), std::string::npos) << first;
  std::istringstream lines(first);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) ++count;
  EXPECT_EQ(count, 5U);  // a comment, the header, three sets
}

TEST(Samples, NeedADeviation) {
  Vehicle v = test::plain_quadrotor();
  for (auto& [name, known] : v.parameters) known.std.reset();
  EXPECT_THROW(sampled_vehicles(v, 1, 1), DataError);
}

// kQ/kT has the relative deviations of both, which are independent: sqrt((3e-9/1.1e-7)^2 + (1e-7/6.1e-6)^2) =
// 0.0318.
TEST(Exports, StateTheIntervalOfWhatIsMadeOfTwoConstants) {
  const Values values = values_for(find_simulator("gz"), test::plain_quadrotor());
  const auto [low, high] = values.interval("rotor1.momentConstant");
  EXPECT_NEAR((high - low) / 2 / 1.96 / values.number("rotor1.momentConstant"), 0.0318, 2e-4);
  EXPECT_NE(values.note("rotor1.momentConstant").find("m; 95 % ["), std::string::npos);
}

}  // namespace
}  // namespace ident
