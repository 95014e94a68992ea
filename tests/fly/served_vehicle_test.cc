// The vehicle on the ground and in the air, and that what is served is the plant of the simulator.
#include "ident/fly/served_vehicle.h"

#include <gtest/gtest.h>

#include "ident/core/random.h"
#include "support/flown_vehicle.h"

namespace ident {
namespace {

using testing::flown_quad;

double height(const ServedVehicle& vehicle) {
  return vehicle.readings().start_W[2] - vehicle.readings().x_W[2];
}

void hold(ServedVehicle& vehicle, double delta, double seconds) {
  const std::vector<double> all(vehicle.vehicle().rotors.size(), delta);
  for (int i = 0; i < static_cast<int>(seconds * 400); ++i) vehicle.step(all, 1.0 / 400);
}

TEST(ServedVehicle, StandsStillWithoutCommandsAndFeelsGravity) {
  ServedVehicle vehicle(flown_quad());
  hold(vehicle, 0.0, 5.0);
  EXPECT_LT(std::abs(height(vehicle)), 1e-6);
  EXPECT_LT(vehicle.readings().v_W.norm(), 1e-6);
  EXPECT_LT((vehicle.readings().f_B - Vec3<double>(0, 0, -9.81)).norm(), 1e-5);
  EXPECT_NEAR(vehicle.readings().t, 5.0, 1e-9);
}

// Thrust goes with the square of the command: at 0.49 it is 96 % of the weight, at 0.52 it is 108 %.
TEST(ServedVehicle, LeavesTheGroundWhenThrustExceedsWeight) {
  ServedVehicle vehicle(flown_quad());
  hold(vehicle, 0.49, 3.0);
  EXPECT_LT(height(vehicle), 0.005);
  hold(vehicle, 0.52, 3.0);
  EXPECT_GT(height(vehicle), 1.0);
}

TEST(ServedVehicle, FallsOntoTheGroundAndNotThroughIt) {
  ServedVehicle vehicle(flown_quad());
  hold(vehicle, 0.7, 1.5);
  ASSERT_GT(height(vehicle), 2.0);
  double lowest = 1.0;
  for (int i = 0; i < 60; ++i) hold(vehicle, 0.0, 0.1), lowest = std::min(lowest, height(vehicle));
  EXPECT_GT(lowest, -0.3);  // deeper than it stands only while legs take up the fall
  EXPECT_LT(std::abs(height(vehicle)), 1e-3);
  EXPECT_LT(vehicle.readings().v_W.norm(), 1e-3);
}

// Two motors alone turn it over: it ends on its back or side, on the ground, and stays there.
TEST(ServedVehicle, LiesOnItsBackWithoutSinking) {
  ServedVehicle vehicle(flown_quad());
  for (int i = 0; i < 400; ++i) vehicle.step(std::vector<double>{0.9, 0.9, 0.0, 0.0}, 1.0 / 400);
  hold(vehicle, 0.0, 10.0);
  EXPECT_GT(height(vehicle), -0.2);
  EXPECT_LT(height(vehicle), 0.4);
  EXPECT_LT(vehicle.readings().v_W.norm(), 0.05);
}

TEST(ServedVehicle, StartsAgainWhereItStood) {
  ServedVehicle vehicle(flown_quad());
  hold(vehicle, 0.8, 2.0);
  vehicle.restart();
  EXPECT_EQ(vehicle.readings().t, 0.0);
  EXPECT_EQ(height(vehicle), 0.0);
  hold(vehicle, 0.0, 1.0);
  EXPECT_LT(std::abs(height(vehicle)), 1e-6);
}

TEST(ServedVehicle, MotorsThatWouldTurnBackwardsStand) {
  Vehicle v = flown_quad();
  v.parameters["Omega_0"] = {-80.0, {}};
  ServedVehicle vehicle(v);
  hold(vehicle, 0.0, 1.0);
  for (const double Omega : vehicle.readings().Omega) EXPECT_NEAR(Omega, 0.0, 1e-9);
}

Vehicle with_effects() {
  Vehicle v = flown_quad();
  for (const auto& [name, value] : {std::pair("rotor_drag.kd", 1e-4),
                                    {"parasitic_drag.C", 0.02},
                                    {"cg_offset.x", 0.004},
                                    {"imu_lever_arm.x", 0.03},
                                    {"axial_inflow.kz", 1e-4},
                                    {"battery_sag.rate", 0.001}})
    v.parameters[name] = {value, {}};
  return v;
}

// Commands around hover as an autopilot gives them. Until the legs have left the ground the plant is given
// what the ground gives; from then on it is alone.
TEST(ServedVehicle, IsThePlantOfTheSimulator) {
  const Vehicle v = with_effects();
  ServedVehicle served(v);
  Plant plant(v);
  const GroundContact ground(plant, 0.0);
  const Vec3<double> rest = Vec3<double>::Zero();
  plant.start(0.0, {Vec4<double>(1, 0, 0, 0), rest, rest, served.readings().start_W},
              std::vector<double>(4, 0.0), std::vector<double>(4, 0.0));
  plant.voltage(0.0, 1.0);
  Random random(3);
  constexpr double h = 1.0 / 400;
  double worst = 0.0, most = 0.0;
  for (int i = 0; i < 4000; ++i) {
    std::vector<double> delta;
    for (int n = 0; n < 4; ++n)
      delta.push_back(std::clamp((i < 200 ? 0.7 : 0.5) + 0.004 * random.normal(), 0.0, 1.0));
    served.step(delta, h);
    plant.command(i * h, delta);
    if (i < 200) {
      for (int k = 1; k <= 5; ++k) {
        const Wrench<double> legs = ground.at(plant.state().body);
        plant.disturb(legs.F_B, legs.M_B);
        plant.advance(i * h + h * k / 5, h);
      }
    } else {
      ASSERT_EQ(ground.at(plant.state().body).F_B.norm(), 0.0) << i;
      plant.disturb(rest, rest);
      plant.advance((i + 1) * h, 5e-4);
    }
    const Readings& r = served.readings();
    const BodyState<double>& body = plant.state().body;
    if (i < 200) continue;
    worst =
        std::max({worst, (r.x_W - body.x_W).norm(), (r.v_W - body.v_W).norm(), (r.q_WB - body.q_WB).norm(),
                  (r.gyro_B - plant.imu().gyro).norm(), (r.f_B - plant.imu().f_B).norm()});
    most = std::max(most, r.v_W.norm());
    if (-r.x_W[2] < 1.0 && i > 400) break;
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(most, 2.0);
}

// Rates and attitude of 12 ms ago, between two steps of 0.5 ms; position and specific force of now.
TEST(ServedVehicle, ShowsRatesAndAttitudeAfterTheDelayOfTheSensors) {
  Vehicle prompt = flown_quad(), late = flown_quad();
  late.parameters["sensor_delay.tau"] = {0.01225, {}};
  ServedVehicle now(prompt), then(late);
  std::vector<Vec3<double>> rates;
  for (int i = 0; i < 600; ++i) {
    const double tilt = i > 200 ? 0.01 * std::sin(0.05 * i) : 0.0;
    const std::vector<double> delta = {0.6 + tilt, 0.6 + tilt, 0.6 - tilt, 0.6 - tilt};
    now.step(delta, 5e-4), then.step(delta, 5e-4);
    rates.push_back(now.readings().gyro_B);
    if (i < 300) continue;
    const std::size_t k = rates.size() - 1;
    const Vec3<double> expected = 0.5 * (rates[k - 24] + rates[k - 25]);  // 12.25 ms are 24.5 steps
    EXPECT_LT((then.readings().gyro_B - expected).norm(), 1e-9);
    EXPECT_LT((then.readings().x_W - now.readings().x_W).norm(), 1e-12);
  }
  EXPECT_GT(rates.back().norm(), 0.01);
}

// After a minute the commands of its first half are gone; nothing is felt of that.
TEST(ServedVehicle, ForgetsOldCommandsWithoutATrace) {
  const Vehicle v = flown_quad();
  ServedVehicle served(v);
  Plant plant(v);
  hold(served, 0.4, 0.0025);
  for (int i = 0; i < 70 * 400; ++i) {
    const double wave = 0.3 + 0.05 * std::sin(0.01 * i);
    served.step(std::vector<double>(4, wave), 1.0 / 400);
  }
  // A rotor follows slow commands with its lag and its dead time: 2 zeta/omega_m + 3 ms = 43 ms.
  const double due = 1000 * (0.3 + 0.05 * std::sin(0.01 * (70 * 400 - 1 - 0.043 * 400 + 0.5)));
  EXPECT_NEAR(served.readings().Omega[0], due, 0.5);
}

}  // namespace
}  // namespace ident
