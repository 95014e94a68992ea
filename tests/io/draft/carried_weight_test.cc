// Commands and rotor speeds of one weight, from a vehicle that climbs, sinks and lands.
#include "ident/io/draft/carried_weight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ident {
namespace {

constexpr double kG = 9.81, kHover = 0.3, kSpeed = 500.0;

/// Thrust of one weight at kHover; the specific force follows the squared command.
FlightLog flight() {
  FlightLog log;
  log.delta.resize(4), log.Omega.resize(4);
  for (int i = 0; i < 400; ++i) {
    const double command = kHover * (1 + 0.2 * std::sin(0.1 * i));
    log.t.push_back(0.01 * i);
    for (auto& rotor : log.delta) rotor.push_back(command);
    for (auto& rotor : log.Omega) rotor.push_back(kSpeed / kHover * command);
    for (auto& axis : log.f_B) axis.push_back(0.0);
    log.f_B[2].back() = -kG * std::pow(command / kHover, 2);
  }
  return log;
}

TEST(CarriedWeight, IsTakenToOneWeightByTheAccelerometer) {
  const CarriedWeight found = carried_weight(flight(), kG);
  EXPECT_NEAR(found.command.value(), kHover, 1e-9);
  EXPECT_NEAR(found.speed.value(), kSpeed, 1e-6);
}

TEST(CarriedWeight, OfALogWithoutItIsTheMedian) {
  FlightLog log = flight();
  for (auto& axis : log.f_B) axis.clear();
  log.Omega.clear();
  const CarriedWeight found = carried_weight(log, kG);
  EXPECT_NEAR(found.command.value(), kHover, 0.02 * kHover);
  EXPECT_FALSE(found.speed);
}

TEST(CarriedWeight, LeavesOutWhatIsNotFlown) {
  FlightLog log = flight();
  log.windows = {{0.0, 1.995}};
  for (std::size_t i = 200; i < log.rows(); ++i)  // on the ground, idle: what it stands on carries it
    for (auto& rotor : log.delta) rotor[i] = 0.05;
  EXPECT_NEAR(carried_weight(log, kG).command.value(), kHover, 1e-9);
  log.windows = {{0.0, 0.5}};  // too little of it
  EXPECT_FALSE(carried_weight(log, kG).command);
}

}  // namespace
}  // namespace ident
