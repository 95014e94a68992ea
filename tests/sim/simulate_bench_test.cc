// Simulated bench data: without noise the estimators give the truth back, and a seed is all there is to
// chance.
#include "ident/sim/simulate_bench.h"

#include <gtest/gtest.h>

#include <functional>

#include "ident/bench/inertia/trifilar_inertia.h"
#include "ident/bench/motor/motor_step.h"
#include "ident/bench/thrust/thrust_sweep.h"
#include "ident/core/error.h"
#include "ident/io/csv/write_csv.h"
#include "ident/model/dc_motor.h"
#include "ident/sim/simulate_inertia.h"
#include "ident/sim/simulate_motor.h"
#include "ident/sim/simulate_thrust.h"
#include "support/random_vehicle.h"

namespace ident {
namespace {

void expect_truth(const Result& found, const Vehicle& truth, std::initializer_list<const char*> names,
                  double tolerance) {
  for (const char* name : names) {
    const Parameter* p = found.find(name);
    ASSERT_TRUE(p) << truth.name << ": " << name;
    EXPECT_NEAR(p->value, truth.value(name), tolerance * truth.value(name)) << truth.name << ": " << name;
  }
}

ThrustSweep clean_sweep() {
  ThrustSweep sweep;
  sweep.noise = sweep.speed_noise = 0.0;
  return sweep;
}

MotorSteps clean_steps() {
  MotorSteps steps;
  steps.noise = 0.0;
  return steps;
}

std::string text(const NumberTable& table) { return table_to_csv(table, CsvDigits::full, {}); }

TEST(SimulateBench, CleanSweepsGiveThrustTorqueAndMotorGainBack) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    ThrustSweep sweep = clean_sweep();
    sweep.tare_thrust = 0.3, sweep.tare_torque = -0.01;
    expect_truth(estimate_thrust({simulate_thrust(vehicle, sweep)}), vehicle, {"kT", "kQ", "km"}, 1e-6);
  }
}

TEST(SimulateBench, CleanStepsGiveTheMotorBack) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    const Result found = estimate_motor({simulate_motor(vehicle, clean_steps())});
    expect_truth(found, vehicle, {"km", "omega_m", "zeta_m"}, 1e-6);
    EXPECT_NEAR(found.find("dead_time")->value, vehicle.value("dead_time"), 1e-7) << vehicle.name;
  }
}

TEST(SimulateBench, CleanSwingsGiveTheInertiaBackAtAnyOffsetAndAmplitude) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    PendulumSwings swings;
    swings.noise = 0.0;
    swings.length = 1.5;
    swings.offset = seed % 2 ? 0.0 : 0.1 * *random_vehicle(3).arm;
    swings.amplitude = seed % 3 ? 0.0 : 0.5;
    expect_truth(estimate_inertia({simulate_inertia(vehicle, swings)}), vehicle, {"Jxx", "Jyy", "Jzz"}, 1e-9);
  }
}

TEST(SimulateBench, SupplyVoltageAndCurrentGiveTheMotorConstantsBack) {
  Vehicle vehicle = random_vehicle(1);
  vehicle.parameters["ki"] = {0.0065, {}}, vehicle.parameters["kv"] = {0.0066, {}};
  vehicle.parameters["R"] = {0.12, {}}, vehicle.parameters["I0"] = {0.6, {}};
  vehicle.parameters["kT"] = {6e-6, {}}, vehicle.parameters["kQ"] = {1e-7, {}};
  ThrustSweep sweep = clean_sweep();
  sweep.supply = 11.1;
  const Result found = estimate_thrust({simulate_thrust(vehicle, sweep)});
  expect_truth(found, vehicle, {"kT", "kQ", "ki", "kv", "R", "I0"}, 1e-6);
}

TEST(SimulateBench, EffectsThatABenchSeesAreInItsData) {
  Vehicle vehicle = random_vehicle(1);
  vehicle.parameters["dead_time"] = {0.004, {}};
  const double usual = (*simulate_motor(vehicle, clean_steps()).find("omega"))[100];
  vehicle.parameters["motor_delay.tau"] = {0.006, {}};
  expect_truth(estimate_motor({simulate_motor(vehicle, clean_steps())}), vehicle, {"omega_m"}, 1e-6);
  EXPECT_NEAR(estimate_motor({simulate_motor(vehicle, clean_steps())}).find("dead_time")->value, 0.010, 1e-7);
  vehicle.parameters["battery_sag.rate"] = {0.01, {}};
  EXPECT_LT((*simulate_motor(vehicle, clean_steps()).find("omega"))[100], usual);
  vehicle.parameters["rotor_mismatch.ratio@2"] = {0.9, {}};
  ThrustSweep sweep = clean_sweep();
  sweep.rotor = 1;
  const Result weak = estimate_thrust({simulate_thrust(vehicle, sweep)});
  EXPECT_NEAR(weak.find("kT")->value, 0.9 * vehicle.value("kT"), 1e-6 * vehicle.value("kT"));
}

TEST(SimulateBench, SlowerSpinDownTakesLongerToFallThanToRise) {
  Vehicle vehicle = random_vehicle(1);
  vehicle.parameters["omega_m"] = {30, {}}, vehicle.parameters["zeta_m"] = {1.0, {}};
  vehicle.parameters["dead_time"] = {0, {}};
  vehicle.parameters["motor_asymmetry.ratio"] = {0.6, {}};
  MotorSteps steps = clean_steps();
  steps.levels = {0.2, 0.8, 0.2};
  steps.hold = 2.0, steps.jitter = 0.0, steps.rate = 1000.0;
  const NumberTable table = simulate_motor(vehicle, steps);
  const std::vector<double>& omega = *table.find("omega");
  const double km = vehicle.value("km");
  const auto after = [&](std::size_t row, double level) {  // rows from an edge until half the step is done
    std::size_t n = 0;
    while (std::abs(omega[row + n] - level * km) > 0.3 * km) ++n;
    return static_cast<double>(n);
  };
  EXPECT_NEAR(after(4000, 0.2) / after(2000, 0.8), 1.0 / 0.6, 0.1);
}

TEST(SimulateBench, TheSameSeedGivesTheSameFileAndAnotherSeedAnotherOne) {
  const Vehicle vehicle = random_vehicle(4);
  ThrustSweep sweep;
  MotorSteps steps;
  PendulumSwings swings;
  const auto all = [&](std::uint64_t seed) {
    sweep.seed = steps.seed = swings.seed = seed;
    return std::array{text(simulate_thrust(vehicle, sweep)), text(simulate_motor(vehicle, steps)),
                      text(simulate_inertia(vehicle, swings))};
  };
  const auto a = all(1), b = all(1), c = all(2);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a[i], b[i]) << i;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NE(a[i], c[i]) << i;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(SimulateBench, WhatTheVehicleOrTheOptionsLackIsNamed) {
  Vehicle vehicle = random_vehicle(1);
  ThrustSweep sweep;
  sweep.supply = 11.1;
  EXPECT_NE(refusal([&] { simulate_thrust(vehicle, sweep); }).find("ki: a positive value"),
            std::string::npos);
  sweep.supply.reset();
  sweep.command = CommandColumn::pulse;
  EXPECT_NE(refusal([&] { simulate_thrust(vehicle, sweep); }).find("'command'"), std::string::npos);
  sweep.command = CommandColumn::delta, sweep.highest = 1.2;
  EXPECT_NE(refusal([&] { simulate_thrust(vehicle, sweep); }).find("between 0 and 1"), std::string::npos);
  EXPECT_NE(refusal([&] { simulate_motor(vehicle, {.rotor = 7}); }).find("rotor"), std::string::npos);
  EXPECT_NE(refusal([&] { simulate_motor(vehicle, {.levels = {0.5}}); }).find("two levels"),
            std::string::npos);
  EXPECT_NE(refusal([&] { simulate_inertia(vehicle, {.offset = 9.0}); }).find("offset"), std::string::npos);
  vehicle.parameters.erase("Jyy");
  EXPECT_NE(refusal([&] { simulate_inertia(vehicle, {}); }).find("Jyy"), std::string::npos);
  vehicle.parameters.erase("omega_m");
  EXPECT_NE(refusal([&] { simulate_motor(vehicle, {}); }).find("omega_m"), std::string::npos);
}

TEST(SimulateBench, NoiseOutliersAndMemoryAreAsLargeAsStated) {
  Random random(1);
  BenchSensor sensor(2.0, {.outliers = 0.1, .autocorrelation = 0.9}, random);
  double square = 0.0, product = 0.0, last = 0.0;
  int far = 0, near = 0, pairs = 0;
  for (int i = 0; i < 50000; ++i) {
    const double n = sensor(7.0) - 7.0;
    const bool is_far = std::abs(n) > 12.0;
    far += is_far;
    if (!is_far) ++near, square += n * n;
    if (!is_far && last != 0.0) ++pairs, product += n * last;
    last = is_far ? 0.0 : n;
  }
  // 0.9 of autocorrelation leaves 50000 (1 - 0.81)/(1 + 0.81) independent squares: their mean is sure to 2 %.
  EXPECT_NEAR(square / near, 4.0, 0.25);
  EXPECT_NEAR(product / pairs / 4.0, 0.9, 0.06);
  EXPECT_NEAR(far / 50000.0, 0.1, 0.006);
}

TEST(DcMotor, HoldsTheSpeedAtWhichItsTorqueIsThePropellers) {
  const DcMotor motor{.ki = 0.006, .kv = 0.0062, .R = 0.2, .I0 = 0.5, .G = 3.0};
  const double kQ = 4e-7, V = 9.0, Omega = motor.steady_speed(V, kQ);
  EXPECT_GT(Omega, 100.0);
  EXPECT_NEAR(motor.surplus_torque(V, Omega, kQ), 0.0, 1e-12);
  EXPECT_GT(motor.surplus_torque(V, 0.9 * Omega, kQ), 0.0);
  EXPECT_EQ(motor.steady_speed(0.05, kQ), 0.0);  // below R I0
}

}  // namespace
}  // namespace ident
