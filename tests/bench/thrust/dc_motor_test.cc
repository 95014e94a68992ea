// Constants of the DC motor from duty, voltage, current, speed and torque; power at hover.
#include "ident/bench/thrust/dc_motor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ident/bench/thrust/thrust_sweep.h"

namespace ident {
namespace {

constexpr double ki = 0.0095, kv = 0.0098, R = 0.12, I0 = 0.6;         // N m/A, V s/rad, Ohm, A
constexpr double kT = 6e-6, kQ = 9e-8, kBattery = 16.0, kWire = 0.02;  // battery: V, Ohm

/// Steady rows from 300 to 1200 rad/s: torque = ki (I - I0), duty V = R I + kv Omega.
MotorRows rows(CurrentSide side, double noise, unsigned seed, int count = 40) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  MotorRows made;
  for (int i = 0; i < count; ++i) {
    const double Omega = 300.0 + 900.0 * i / (count - 1), torque = kQ * Omega * Omega, I = torque / ki + I0;
    const double V_motor = R * I + kv * Omega;
    // A speed controller passes power on: V I_battery = V_motor I with V = battery - wire I_battery.
    const double half = 0.5 * kBattery / kWire;
    const double I_battery = half - std::sqrt(half * half - V_motor * I / kWire);
    const double V = kBattery - kWire * I_battery;
    made.Omega.push_back(Omega);
    made.voltage.push_back(V);
    made.delta.push_back(V_motor / V);
    made.current.push_back(side == CurrentSide::motor ? I : I_battery);
    made.torque.push_back(torque + noise * kQ * 1200.0 * 1200.0 * normal(random));
    made.voltage.back() *= 1.0 + 0.2 * noise * normal(random);
  }
  return made;
}

const Parameter& named(const MotorConstants& found, const std::string& name) {
  return *std::ranges::find(found.parameters, name, &Parameter::name);
}

TEST(DcMotor, ExactRowsGiveExactConstantsWhereverTheCurrentWasMeasured) {
  for (const CurrentSide side : {CurrentSide::motor, CurrentSide::battery}) {
    const auto found = motor_constants(rows(side, 0.0, 1));
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->side, side);
    EXPECT_TRUE(found->side_is_clear);
    EXPECT_TRUE(found->missing.empty());
    for (const auto& [name, truth] : {std::pair{"ki", ki}, {"kv", kv}, {"R", R}, {"I0", I0}}) {
      EXPECT_NEAR(named(*found, name).value, truth, 1e-9) << name;
      EXPECT_TRUE(named(*found, name).identifiable) << name;
    }
  }
}

// 200 sweeps with noise of 1 % of full torque and 0.2 % of the voltage: 95 % intervals hold the truth within
// four binomial standard errors (6.2 %).
TEST(DcMotor, IntervalsOfNoisyRowsHoldTheTruth) {
  constexpr int runs = 200;
  std::map<std::string, int> held;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const auto found = motor_constants(rows(CurrentSide::battery, 0.01, seed));
    ASSERT_EQ(found->side, CurrentSide::battery) << seed;
    for (const auto& [name, truth] : {std::pair{"ki", ki}, {"kv", kv}, {"R", R}, {"I0", I0}}) {
      const Parameter& p = named(*found, name);
      EXPECT_NEAR(p.value, truth, 6.0 * p.std) << name << " " << seed;
      held[name] += p.ci95[0] <= truth && truth <= p.ci95[1];
    }
  }
  for (const auto& [name, times] : held) EXPECT_GE(times, 0.888 * runs) << name;
}

TEST(DcMotor, TheBatterysSideAloneDoesNotTell) {
  MotorRows without = rows(CurrentSide::battery, 0.0, 1);
  without.delta.clear();
  const auto found = motor_constants(without);
  ASSERT_TRUE(found.has_value());
  EXPECT_NE(found->missing.find("battery"), std::string::npos) << found->missing;
  EXPECT_NE(found->missing.find("duty"), std::string::npos) << found->missing;
  ASSERT_EQ(found->parameters.size(), 4u);
  for (const Parameter& p : found->parameters) {
    EXPECT_FALSE(p.identifiable) << p.name;
    EXPECT_FALSE(std::isfinite(p.value)) << p.name;
  }
}

TEST(DcMotor, WithoutTorqueResistanceAndBackEmfAreLeft) {
  MotorRows without = rows(CurrentSide::motor, 0.0, 1);
  without.torque.clear();
  const auto found = motor_constants(without);
  EXPECT_NE(found->missing.find("torque"), std::string::npos);
  EXPECT_FALSE(named(*found, "ki").identifiable);
  EXPECT_NEAR(named(*found, "R").value, R, 1e-9);
}

TEST(DcMotor, WithoutVoltageAndCurrentThereIsNothingToSay) {
  MotorRows none = rows(CurrentSide::motor, 0.0, 1);
  none.voltage.clear(), none.current.clear();
  EXPECT_FALSE(motor_constants(none).has_value());
}

/// The same rows as a thrust sweep, with rows at rest.
NumberTable sweep(bool with_duty) {
  const MotorRows r = rows(CurrentSide::battery, 0.0, 1);
  NumberTable table{.file = "sweep.csv"};
  std::vector<double> omega(3, 0.0), thrust(3, 0.0), torque(3, 0.0), delta(3, 0.0), voltage(3, kBattery),
      current(3, 0.0);
  for (std::size_t i = 0; i < r.Omega.size(); ++i) {
    omega.push_back(r.Omega[i]);
    thrust.push_back(kT * r.Omega[i] * r.Omega[i]);
    torque.push_back(r.torque[i]);
    delta.push_back(r.delta[i]);
    voltage.push_back(r.voltage[i]);
    current.push_back(r.current[i]);
  }
  for (std::size_t i = 0; i < omega.size(); ++i) table.line.push_back(static_cast<long>(i) + 2);
  table.columns = {{"omega", "omega", omega},
                   {"thrust", "thrust", thrust},
                   {"torque", "torque", torque},
                   {"voltage", "voltage", voltage},
                   {"current", "current", current}};
  if (with_duty) table.columns.push_back({"delta", "delta", delta});
  return table;
}

TEST(DcMotor, ASweepGivesTheConstantsAndWhereTheCurrentWasMeasured) {
  const Result result = estimate_thrust({sweep(true)});
  for (const auto& [name, truth] : {std::pair{"ki", ki}, {"kv", kv}, {"R", R}, {"I0", I0}}) {
    ASSERT_NE(result.find(name), nullptr) << name;
    EXPECT_NEAR(result.find(name)->value / truth, 1.0, 1e-3) << name;
  }
  EXPECT_EQ(result.extra["current_measured_at"], "battery");
}

TEST(DcMotor, ASweepWithoutDutySaysThatItCannotTell) {
  const Result result = estimate_thrust({sweep(false)});
  EXPECT_TRUE(result.has_warning("motor_not_identifiable"));
  EXPECT_FALSE(result.find("ki")->identifiable);
}

// At T = 2.4525 N: Omega = sqrt(T/kT) = 639.3 rad/s, shaft kQ Omega^3 = 23.52 W, momentum theory
// T^1.5/sqrt(2 rho pi r^2) = 3.8407/sqrt(0.076969) = 13.844 W.
TEST(DcMotor, PowerAtHoverIsComparedWithMomentumTheory) {
  const double T = 0.25 * 9.81;
  const Result result = estimate_thrust({sweep(true)}, {.radius = 0.1, .rho = 1.225, .hover_thrust = T});
  const auto& hover = result.extra["hover"];
  EXPECT_NEAR(hover["rotor_speed"].get<double>(), 639.33, 0.1);
  EXPECT_NEAR(hover["shaft_power"].get<double>(), 23.52, 0.02);
  EXPECT_NEAR(hover["momentum_power"].get<double>(), 13.844, 0.002);
  const double Q = kQ * T / kT, I = Q / ki + I0, Omega = std::sqrt(T / kT);
  // Linear between the set-points around hover, 23 rad/s apart.
  EXPECT_NEAR(hover["electrical_power"].get<double>() / ((R * I + kv * Omega) * I), 1.0, 2e-3);
  EXPECT_NEAR(hover["efficiency"].get<double>(),
              hover["momentum_power"].get<double>() / hover["electrical_power"].get<double>(), 1e-12);
}

}  // namespace
}  // namespace ident
