// Manoeuvres by each simulator's own equations against ident's model of what the file holds: 1e-6 m, m/s,
// rad/s.
#include <gtest/gtest.h>

#include "ident/io/simulators/reduced.h"
#include "ident/io/simulators/simulators.h"
#include "ident/model/flight.h"
#include "io/simulators/equations/by_thrust.h"
#include "io/simulators/equations/gazebo.h"
#include "io/simulators/equations/rotorpy.h"
#include "io/simulators/simulator_vehicles.h"

namespace ident {
namespace {

using test::fly;

constexpr double kAgrees = 1e-6;

/// A vehicle for `target`, its file as `Fields`, and what ident makes of the file.
struct Exported {
  Exported(const char* target, Vehicle vehicle) : format(find_simulator(target)) {
    const std::string text = export_to_simulator(format, vehicle).text;
    fields.emplace(format.read(text, "made"));
    read_back = vehicle_of_simulator(format, text, "made");
  }
  const SimulatorFormat& format;
  std::optional<Fields> fields;
  Vehicle read_back;
};

Vehicle with(std::initializer_list<std::pair<const char*, double>> constants) {
  Vehicle v = test::plain_quadrotor();
  for (const auto& [name, value] : constants) v.parameters[name] = {value, {}};
  return v;
}

void expect_agreement(const test::SimulatorEquations& equations, const Vehicle& vehicle) {
  const test::Manoeuvre slow = test::hover_and_steps(vehicle), fast = test::fast_forward(vehicle);
  const test::Flown flown = fly(equations, slow);
  EXPECT_LT(test::largest_difference(flown, fly(vehicle, slow)), kAgrees);
  EXPECT_LT(test::largest_difference(fly(equations, fast), fly(vehicle, fast)), kAgrees);
  // The manoeuvre moves it: rates above 0.5 rad/s, metres of way.
  double rate = 0;
  for (const auto& state : flown) rate = std::max(rate, state.tail<3>().cwiseAbs().maxCoeff());
  EXPECT_GT(rate, 0.5);
}

/// Motors so fast that it does not matter whether the lag acts on the speed or on the thrust.
Vehicle with_instant_motors(Vehicle v) {
  set_first_order(v, 1e-7, 0.0);
  return v;
}

TEST(SimulatorEquations, RotorPyFliesAsTheModelOfItsFile) {
  const Exported e("rotorpy", with({{"rotor_drag.kd", 3e-5},
                                    {"axial_inflow.kz", 4e-5},
                                    {"translational_lift.kh", 2e-3},
                                    {"blade_flapping.kf", 3e-6},
                                    {"parasitic_drag.C", 8e-3},
                                    {"Jxy", 5e-5},
                                    {"Jxz", -4e-5},
                                    {"Jyz", 3e-5},
                                    {"cg_offset.x", 2e-3},
                                    {"cg_offset.z", 4e-3}}));
  expect_agreement(test::rotorpy_equations(*e.fields), e.read_back);
}

TEST(SimulatorEquations, GazeboFliesAsTheModelOfItsFile) {
  Vehicle v = with({{"rotor_drag.kd", 3e-5},
                    {"Jxy", 5e-5},
                    {"Jxz", -4e-5},
                    {"Jyz", 3e-5},
                    {"rotor_mismatch.ratio@2", 0.93},
                    {"rotor_tilt.x@3", 0.03},
                    {"rotor_tilt.y@1", -0.02}});
  const Exported e("gz", v);
  expect_agreement(test::gazebo_equations(*e.fields, 4), e.read_back);
}

TEST(SimulatorEquations, GazeboClassicFliesAsTheModelOfItsFile) {
  const Exported e("gz-classic", with({{"rotor_drag.kd", 3e-5}}));
  expect_agreement(test::gazebo_equations(*e.fields, 4), e.read_back);
}

TEST(SimulatorEquations, SihFliesAsTheModelOfItsFileWhereMotorsFollowAtOnce) {
  Vehicle v = with_instant_motors(
      with({{"Kdx", 0.2}, {"Kdy", 0.2}, {"Kdz", 0.2}, {"Jxy", 5e-5}, {"Jxz", -4e-5}, {"Jyz", 3e-5}}));
  v.parameters.erase("Omega_0");
  const Exported e("px4-sih", v);
  expect_agreement(test::sih_equations(*e.fields), e.read_back);
}

TEST(SimulatorEquations, MuJoCoFliesAsTheModelOfItsFileWhereMotorsFollowAtOnce) {
  Vehicle v =
      with_instant_motors(with({{"Jxy", 5e-5}, {"Jxz", -4e-5}, {"Jyz", 3e-5}, {"rotor_tilt.x@3", 0.03}}));
  v.parameters.erase("Omega_0");
  const Exported e("mujoco", v);
  expect_agreement(test::mujoco_equations(*e.fields, 4), e.read_back);
}

TEST(SimulatorEquations, ArduPilotFliesAsTheModelOfItsFileButForYaw) {
  Vehicle v =
      with({{"parasitic_drag.C", 8e-3}, {"kQ", 1e-16}});  // its yaw torque goes with thrust times command
  v.parameters.erase("Omega_0");  // with an offset its polynomial agrees at hover only
  const Exported e("ardupilot", v);
  Vehicle read = e.read_back;
  set_first_order(read, 1e-7, 0.0);  // motors follow at once there
  expect_agreement(test::ardupilot_equations(*e.fields), read);
}

TEST(SimulatorEquations, GymPybulletFliesAsTheModelOfItsFileWithoutDrag) {
  const Exported e("urdf", with({}));
  Vehicle read = e.read_back;
  set_first_order(read, 1e-7, 0.0);
  expect_agreement(test::pybullet_equations(*e.fields), read);
}

TEST(SimulatorEquations, CrazyflowFliesAsTheModelOfItsFileWithoutDragAndGyroscopicTorque) {
  const Exported e("crazyflow", with({{"Jxy", 5e-5}, {"Jxz", -4e-5}, {"Jyz", 3e-5}, {"Jp", 0.0}}));
  expect_agreement(test::crazyflow_equations(*e.fields), e.read_back);
}

// ident blends the two time constants within a few rad/s of the target, so that the change has a derivative;
// a rotor that is 60 rad/s and more away follows one of them alone.
TEST(SimulatorEquations, RotorsSlowDownByTheTimeConstantOfTheFile) {
  for (const char* target : {"gz", "gz-classic", "crazyflow"}) {
    const Exported e(target, with({{"motor_asymmetry.ratio", 0.7}}));
    const double up = motor_lags(e.read_back).up, down = motor_lags(e.read_back).down;
    EXPECT_NEAR(down, up / 0.7, 1e-9);
    const std::vector<double> p = parameter_vector(e.read_back);
    const EffectSet<double> effects(p, active_effects(p));
    FlightInputs inputs;
    inputs.delta.assign(4, HeldCommand({0.0}, {0.2}));
    Flight<double, EffectSet<double>> flight(e.read_back, p, effects, inputs);
    const double goal = flight.steady_speed(0, 0.0), far = 400.0, t = 5e-3;
    std::array<MotorState<double>, kMaxRotors> above{}, below{};
    above[0] = {goal + far, -far / down}, below[0] = {goal - 100.0, 100.0 / up};
    flight.advance(above, 0.0, t), flight.advance(below, 0.0, t);
    EXPECT_NEAR(above[0].Omega, goal + far * std::exp(-t / down), 1e-6 * far) << target;
    EXPECT_NEAR(below[0].Omega, goal - 100.0 * std::exp(-t / up), 1e-6 * far) << target;
  }
}

// At hover speed and level, drag of the rotors is the same force whatever it is made of.
TEST(SimulatorEquations, DragAgreesAtHoverSpeedWhereTheFileHoldsAnotherForm) {
  Vehicle v = with({{"rotor_drag.kd", 3e-5}, {"axial_inflow.kz", 4e-5}});
  v.parameters.erase("Omega_0");
  for (Rotor& rotor : v.rotors) rotor.r_B.z() = 0.0;
  const Exported flow("crazyflow", v), urdf("urdf", v), sih("px4-sih", v);
  test::SimulatorState s;
  s.v = {4.0, 2.0, 1.0};
  const double Omega = hover_speed(flow.read_back), rpm = Omega * 30 / std::numbers::pi, weight = 0.7 * 9.81;
  const auto drag = [&](const test::SimulatorEquations& e, double motor, double g) {
    s.motors.assign(4, motor);
    return Eigen::Vector3d(e.wrench(s, {0, 0, 0, 0}).F - Eigen::Vector3d(0, 0, 0.7 * g));
  };
  const Eigen::Vector3d rotors = -4 * Omega * Eigen::Vector3d(3e-5 * 4.0, 3e-5 * 2.0, 4e-5 * 1.0);
  EXPECT_LT((drag(test::crazyflow_equations(*flow.fields), rpm, 9.81) - rotors).norm(), 1e-9 * weight);
  const double rpm_98 = hover_speed(urdf.read_back) * 30 / std::numbers::pi;
  EXPECT_LT(
      (drag(test::pybullet_equations(*urdf.fields), rpm_98, 9.8) - rotors * std::sqrt(9.8 / 9.81)).norm(),
      1e-9 * weight);
  const Eigen::Vector3d isotropic =
      -4 * hover_speed(sih.read_back) * 0.0 * rotors - sih.read_back.value("Kdx") * s.v;
  const double u = 0.7 * 9.80665 / (4 * sih.fields->number("SIH_T_MAX"));
  EXPECT_LT((drag(test::sih_equations(*sih.fields), u, 9.80665) - isotropic).norm(), 1e-9 * weight);
}

}  // namespace
}  // namespace ident
