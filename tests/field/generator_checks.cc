// The generator's own checks: laws of motion, filters, motors, air, statement, reproducibility, sane flights.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drive.h"
#include "field_case.h"
#include "filters.h"

namespace field {
namespace {

Vehicle a_vehicle(std::uint64_t seed) {
  Random random(seed, 0, "vehicle");
  return draw_vehicle(random);
}

RotorState turning(const Vehicle& v, double Omega) {
  const PerRotor zero = PerRotor::Zero(v.rotors());
  return {PerRotor::Constant(v.rotors(), Omega), zero, zero, zero};
}

Effects all_air_loads(const Vehicle& v) {
  Random random(3, 0, "effects");
  Effects e = draw_effects(random, v, false, "full");
  e.c_B.setZero();
  e.weak_rotor = -1;
  e.ground_radius = 0;
  e.wind_W.setZero();
  return e;
}

TEST(FieldBody, RotorsAtHoverSpeedCarryTheWeightAndDoNotTurnTheBody) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Vehicle v = a_vehicle(seed);
    const Motion high{.p_W = Vector3d(0, 0, -50)};
    const Acceleration a = accelerate(v, all_air_loads(v), high, turning(v, v.hover_speed()), {});
    EXPECT_NEAR((a.f_B - Vector3d(0, 0, -kGravity)).norm(), 0, 1e-6);
    EXPECT_NEAR(a.dw_B.norm(), 0, 1e-3);  // hubs are stated to a micrometre
    EXPECT_GT(v.J.x() + v.J.y(), v.J.z());
    EXPECT_GT(std::min(v.J.x(), v.J.y()) + v.J.z(), std::max(v.J.x(), v.J.y()));
  }
}

TEST(FieldBody, FreeTumblingKeepsEnergyAndAngularMomentum) {
  const Vehicle v = a_vehicle(1);
  const Effects e;
  Motion motion{.w_B = Vector3d(3, -2, 4)};
  const auto momentum = [&](const Motion& m) -> Vector3d { return m.q_WB * (v.J.asDiagonal() * m.w_B); };
  const auto energy = [&](const Motion& m) { return 0.5 * m.w_B.dot(v.J.cwiseProduct(m.w_B)); };
  const Vector3d L = momentum(motion);
  const double E = energy(motion);
  for (int k = 0; k < 10000; ++k) {  // 5 s
    motion = advance(v, e, motion, accelerate(v, e, motion, turning(v, 0), {}), 5e-4);
  }
  EXPECT_NEAR(energy(motion), E, 1e-4 * E);
  EXPECT_NEAR((momentum(motion) - L).norm(), 0, 1e-3 * L.norm());
}

TEST(FieldBody, ARotorThatSpinsUpTurnsTheBodyAgainstIt) {
  Vehicle v = a_vehicle(2);
  v.kQ = 0;
  RotorState rotors = turning(v, v.hover_speed());
  rotors.dOmega[0] = 100;  // the first is counter-clockwise: momentum along (0, 0, -1)
  const Acceleration a = accelerate(v, {}, {}, rotors, {});
  EXPECT_NEAR(a.dw_B.z() * v.J.z(), v.Jp * 100, 1e-6 * v.Jp * 100);
}

TEST(FieldRotor, StaticThrustIsQuadraticFallsInClimbAndRisesInForwardFlight) {
  const Vehicle v = a_vehicle(4);
  const Effects e = all_air_loads(v);
  const double W = v.hover_speed(), T = v.kT * W * W;
  EXPECT_NEAR(rotor_thrust(v, e, W, 0, 0), T, 1e-6 * T);
  EXPECT_NEAR(rotor_thrust(v, e, 2 * W, 0, 0), 4 * T, 1e-6 * T);
  EXPECT_LT(rotor_thrust(v, e, W, 0, 1), T);
  EXPECT_GT(rotor_thrust(v, e, W, 5, 0), T);
  EXPECT_EQ(rotor_thrust(v, {}, W, 5, 1), T);
}

TEST(FieldRotor, AirInThePlaneOfTheRotorTakesEnergy) {
  const Vehicle v = a_vehicle(5);
  const Effects e = all_air_loads(v);
  for (const Vector3d& u : {Vector3d(4, 1, 0), Vector3d(-3, 2, 1), Vector3d(0, -6, -1)}) {
    const RotorLoad load = rotor_load(v, e, 0, v.hover_speed(), {.v_B = u});
    EXPECT_LE(load.across_B.dot(u), 0);
    EXPECT_GE(load.hub_B.y() * u.x(), 0);  // nose up in forward flight
  }
}

double gain_at(int order, double hz, double rate) {
  LowPass filter(order, hz, rate);
  double most = 0;
  for (int k = 0; k < 20000; ++k) {
    const double y = filter(Vector3d::Constant(std::sin(2 * std::numbers::pi * hz * k / rate))).x();
    if (k > 10000) most = std::max(most, std::abs(y));
  }
  return most;
}

TEST(FieldFilters, PassHalfThePowerAtTheirCutOffAndDelayARampAsStated) {
  for (const int order : {1, 2, 4}) {
    EXPECT_NEAR(gain_at(order, 40, 2000), std::numbers::sqrt2 / 2, 2e-3);
    LowPass filter(order, 40, 2000);
    double y = 0;
    for (int k = 0; k <= 4000; ++k) y = filter(Vector3d::Constant(k / 2000.0)).x();
    EXPECT_NEAR(2.0 - y, group_delay(order, 40), 2e-5);
  }
}

TEST(FieldFilters, LetNoiseThroughAsTheirBandwidth) {
  for (const int order : {1, 2, 4}) {
    LowPass filter(order, 60, 2000);
    Random random(1, static_cast<std::uint64_t>(order), "noise");
    double sum = 0;
    constexpr int kSamples = 400000;
    for (int k = 0; k < kSamples; ++k) sum += std::pow(filter(Vector3d::Constant(random.normal())).x(), 2);
    // The bilinear transform has a zero at the Nyquist frequency, which the slow fall of order 1 feels.
    const double expected = noise_bandwidth(order, 60) / 1000, tolerance = order == 1 ? 0.11 : 0.04;
    EXPECT_NEAR(sum / kSamples, expected, tolerance * expected);
  }
}

TEST(FieldDrive, MotorsReach63PercentAfterTheirLagAndLatency) {
  Vehicle v = a_vehicle(6);
  v.Omega_0 = 0;
  v.latency = 0.004;
  const double dt = 5e-4, low = 0.3 * v.km, high = 0.6 * v.km;
  for (const bool up : {true, false}) {
    const double from = up ? low : high, to = up ? high : low;
    Drive drive(v, {}, {}, dt, PerRotor::Constant(v.rotors(), from));
    double t = 0;
    while (std::abs(drive.Omega()[0] - from) < (1 - std::exp(-1.0)) * std::abs(to - from)) {
      drive.advance(PerRotor::Constant(v.rotors(), to / v.km), v.battery.reference);
      t += dt;
    }
    EXPECT_NEAR(t, 0.004 + (up ? v.lag_up : v.lag_down), 2 * dt);
  }
}

TEST(FieldAir, GustsHaveTheStatedDeviation) {
  const AirLevel light = air_level("light");
  double across = 0, along = 0;
  constexpr int kFlights = 60, kSteps = 2000;
  for (int i = 0; i < kFlights; ++i) {
    Gusts gusts(light, 1, 0.3, Random(1, static_cast<std::uint64_t>(i), "gusts"), 0.02);
    for (int k = 0; k < kSteps; ++k) {
      const Vector3d v = gusts.next().v_W;
      across += v.x() * v.x();
      along += v.z() * v.z();
    }
  }
  EXPECT_NEAR(std::sqrt(across / (kFlights * kSteps)), light.across, 0.1 * light.across);
  EXPECT_NEAR(std::sqrt(along / (kFlights * kSteps)), light.along, 0.1 * light.along);
}

TEST(FieldStatement, HonestErrorsAreDrawsOfTheirDeviations) {
  double sum = 0;
  int count = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = draw_case(9, i, "");
    for (const auto& [name, constant] : c.stated.constants) {
      if (constant.overconfident) continue;
      sum += std::pow((constant.value - constant.truth) / constant.std, 2);
      ++count;
    }
  }
  // A normal deviate cut at 2.2 has a deviation of 0.916; those of the value's size spread by some per cent
  // more.
  EXPECT_NEAR(std::sqrt(sum / count), 0.93, 0.06);
}

TEST(FieldCase, IsTheSameWhateverTheOthersAre) {
  const auto flown = [](std::uint64_t index) {
    Case c = draw_case(5, index, "");
    for (auto& s : c.settings) s.duration = 3;
    fly_case(c);
    return c;
  };
  (void)flown(2);
  const Case a = flown(3);
  (void)flown(1);
  const Case b = flown(3), other = flown(4);
  for (size_t i = 0; i < 3; ++i) {
    const Row &x = a.flights[i].rows.back(), &y = b.flights[i].rows.back();
    EXPECT_EQ((x.accel - y.accel).norm(), 0);
    EXPECT_EQ((x.v_W - y.v_W).norm(), 0);
  }
  EXPECT_NE(a.v.m, other.v.m);
}

TEST(FieldCase, FlightsAreSane) {
  for (std::uint64_t i = 0; i < 8; ++i) {
    Case c = draw_case(6, i, "");
    for (auto& s : c.settings) s.duration = 20;
    fly_case(c);
    for (const Flight& f : c.flights) {
      EXPECT_NEAR(f.mean_thrust, 1, 0.03);
      EXPECT_LT(f.greatest_rate, 8);
      EXPECT_LT(f.greatest_tilt, 1.2);
      EXPECT_LT(f.saturated, 0.05);
      EXPECT_GT(f.lowest, 0);
      EXPECT_GT(f.command_most, f.command_least + 0.02);
    }
  }
}

TEST(FieldCase, APlainCaseHoldsNothingButWhatItsFileStates) {
  for (std::uint64_t i = 0; i < 40; i += 5) {
    const Case c = draw_case(7, i, "");
    ASSERT_TRUE(c.plain);
    EXPECT_TRUE(outside_present(c).empty());
    for (const auto& name : names_present(c)) EXPECT_TRUE(name.starts_with("parameter:")) << name;
    for (const auto& [name, constant] : c.stated.constants) EXPECT_FALSE(constant.overconfident) << name;
  }
}

}  // namespace
}  // namespace field
