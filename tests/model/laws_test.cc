// Laws of mechanics that the model has to keep whatever its constants are.
#include <gtest/gtest.h>

#include "ident/core/random.h"
#include "ident/effects/catalogue.h"
#include "ident/model/within_step.h"
#include "support/random_vehicle.h"
#include "support/restless_commands.h"

namespace ident {
namespace {

using testing::restless_commands;
using Vector = Vec3<double>;

FlightState<double> moving_state(const std::vector<double>& p, std::size_t rotors) {
  FlightState<double> x;
  x.body = {Vec4<double>(0.9, 0.2, -0.3, 0.25).normalized(), Vector(1.0, -2.0, 0.7), Vector(1.0, 2.0, -0.5),
            Vector(0.3, 0.1, -20.0)};
  for (std::size_t n = 0; n < rotors; ++n) x.motors[n] = {0.5 * p[param::km], 0.0};
  return x;
}

/// The vehicle without effects, one second on its own commands, in steps of `h`.
FlightState<double> flown(const Vehicle& vehicle, const std::vector<double>& p, const FlightInputs& inputs,
                          FlightState<double> x, double h = 2e-4, double duration = 1.0) {
  const NoEffects none;
  Flight<double> flight(vehicle, p, none, inputs);
  const int steps = static_cast<int>(std::lround(duration / h));
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    x = flight.step(x, t, h, flight.rate(x, t));
    x.body.q_WB.normalize();
  }
  return x;
}

/// J w + sum s Jp Omega a in the world frame: of body and rotors about the centre of gravity.
Vector angular_momentum(const Vehicle& vehicle, const std::vector<double>& p, const FlightState<double>& x) {
  const NoEffects none;
  Vector H_B = Body<double>(vehicle, p, none).J() * x.body.w_B;
  for (std::size_t n = 0; n < vehicle.rotors.size(); ++n) {
    const Rotor& rotor = vehicle.rotors[n];
    H_B += rotor.s * p[param::Jp] * x.motors[n].Omega * axis_at(rotor, p[param::alpha]);
  }
  return rotation(x.body.q_WB) * H_B;
}

Vector momentum_change(const Vehicle& vehicle) {
  std::vector<double> p = parameter_vector(vehicle);
  p[param::kT] = p[param::kQ] = 0.0;  // rotors in a vacuum: they turn and push nothing
  p[param::dead_time] = 0.0;          // commands change between steps, where the integrator sees no edge
  const FlightState<double> start = moving_state(p, vehicle.rotors.size());
  const FlightState<double> end = flown(vehicle, p, restless_commands(vehicle.rotors.size()), start);
  return angular_momentum(vehicle, p, end) - angular_momentum(vehicle, p, start);
}

TEST(Laws, AngularMomentumOfBodyAndRotorsIsConservedWithoutExternalTorque) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Vehicle vehicle = random_vehicle(seed);
    vehicle.parameters["Jxz"] = {0.05 * vehicle.value("Jxx"), {}};
    const double scale = vehicle.value("Jxx") + vehicle.value("Jp") * vehicle.value("km");
    EXPECT_LT(momentum_change(vehicle).norm(), 1e-9 * scale) << vehicle.name;
  }
}

// Erratum 1 of [Phang] (16), (18), (19).
TEST(Laws, PublishedSignsOfReactionAndGyroscopicTorqueBreakTheConservationOfMomentum) {
  Vehicle vehicle = random_vehicle(1);
  vehicle.rotors = layout_rotors("4sp", 0.17, 0.1);
  vehicle.signs = Signs::as_published;
  EXPECT_GT(momentum_change(vehicle).norm(), 0.1 * vehicle.value("Jp") * vehicle.value("km"));
}

TEST(Laws, GyroscopicTorqueDoesNoWork) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    std::vector<double> p = parameter_vector(vehicle), without = p;
    without[param::Jp] = 0.0;
    const NoEffects none;
    const FlightState<double> x = moving_state(p, vehicle.rotors.size());
    Random random(seed);
    std::vector<MotorState<double>> motors;  // steady rotors: all of the torque is gyroscopic
    for (std::size_t n = 0; n < vehicle.rotors.size(); ++n) motors.push_back({random.uniform(0, 900), 0.0});
    const Mat3<double> R_WB = rotation(x.body.q_WB);
    const Vector M_B = Body<double>(vehicle, p, none).wrench(x.body, R_WB, motors).M_B -
                       Body<double>(vehicle, without, none).wrench(x.body, R_WB, motors).M_B;
    EXPECT_GT(M_B.norm(), 0.0);
    EXPECT_LT(std::abs(M_B.dot(x.body.w_B)), 1e-12 * M_B.norm()) << vehicle.name;
  }
}

TEST(Laws, EnergyIsConservedInFreeFall) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Vehicle vehicle = random_vehicle(seed);
    vehicle.parameters["Jxy"] = {0.1 * vehicle.value("Jxx"), {}};
    const std::vector<double> p = parameter_vector(vehicle);
    FlightState<double> start = moving_state(p, vehicle.rotors.size());
    FlightInputs still;
    still.delta.resize(vehicle.rotors.size(), HeldCommand({0.0}, {0.0}));
    for (auto& motor : start.motors) motor = {0.0, 0.0};
    const FlightState<double> end = flown(vehicle, p, still, start);
    const NoEffects none;
    const Mat3<double> J = Body<double>(vehicle, p, none).J();
    const double m = p[param::m];
    const auto turning = [&](const FlightState<double>& x) { return 0.5 * x.body.w_B.dot(J * x.body.w_B); };
    const auto moving = [&](const FlightState<double>& x) {
      return 0.5 * m * x.body.v_W.squaredNorm() - m * vehicle.g * x.body.x_W[2];  // z points down
    };
    EXPECT_NEAR(turning(end), turning(start), 1e-10 * turning(start)) << vehicle.name;
    EXPECT_NEAR(moving(end), moving(start), 1e-10 * m * vehicle.g) << vehicle.name;
    EXPECT_GT((end.body.w_B - start.body.w_B).norm(), 1e-3);
  }
}

void expect_same_motion(const FlightState<double>& a, const FlightState<double>& b, const std::string& who) {
  EXPECT_LT((a.body.w_B - b.body.w_B).norm(), 1e-9 * (1.0 + a.body.w_B.norm())) << who;
  EXPECT_LT((a.body.v_W - b.body.v_W).norm(), 1e-9 * (1.0 + a.body.v_W.norm())) << who;
  EXPECT_LT((a.body.q_WB - b.body.q_WB).norm(), 1e-9) << who;
}

// Half the step makes a quarter and a sixteenth of the error.
TEST(Laws, StepsConvergeAsTheirOrderSays) {
  const NoEffects none;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    std::vector<double> p = parameter_vector(vehicle);
    p[param::dead_time] = 0.0;  // commands change between steps
    const FlightInputs inputs = restless_commands(vehicle.rotors.size());
    const auto turned = [&](int order, int steps) {
      Flight<double> flight(vehicle, p, none, inputs);
      flight.step_to_order(order);
      FlightState<double> x = moving_state(p, vehicle.rotors.size());
      BodyRate<double> rate = flight.rate(x, 0.0);
      const double h = 0.5 / steps;
      for (int i = 0; i < steps; ++i) flight.step_on(x, i * h, h, rate);
      return x.body.w_B;
    };
    const Vector exact = turned(4, 3200);
    for (const int order : {2, 4}) {
      const double coarse = (turned(order, 100) - exact).norm(), fine = (turned(order, 200) - exact).norm();
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.5) << vehicle.name;
    }
  }
}

// What is read off a long step half way and elsewhere is where short steps lead.
TEST(Laws, WithinALongStepItIsWhereShortOnesLead) {
  const NoEffects none;
  constexpr double h = 8e-3;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    std::vector<double> p = parameter_vector(vehicle);
    p[param::dead_time] = 0.0;
    const FlightInputs inputs = restless_commands(vehicle.rotors.size());
    const FlightState<double> start = moving_state(p, vehicle.rotors.size());
    Flight<double> flight(vehicle, p, none, inputs), exact(vehicle, p, none, inputs);
    flight.step_to_order(2);
    FlightState<double> end = start, x = start;
    StepMiddle<double> middle;
    const BodyRate<double> at_start = flight.rate(x, 0.0);
    BodyRate<double> rate = at_start, now = at_start;
    flight.step_on(end, 0.0, h, rate, middle);
    const WithinStep<double> within(h, start, at_start, middle, end, rate);
    EXPECT_LT((within.body(1.0).w_B - end.body.w_B).norm(), 1e-13) << vehicle.name;
    EXPECT_EQ(within.body(0.0).w_B, start.body.w_B);
    constexpr int kShort = 80;
    for (int i = 1; i < kShort; ++i) {
      exact.step_on(x, (i - 1) * h / kShort, h / kShort, now);
      const double u = static_cast<double>(i) / kShort, changes = (rate.f_B - at_start.f_B).norm();
      const BodyState<double> here = within.body(u);
      EXPECT_LT((here.w_B - x.body.w_B).norm(), 5e-2 * h * (1 + at_start.w_dot_B.norm())) << u;
      EXPECT_LT((here.q_WB - x.body.q_WB).norm(), 1e-4) << u;
      EXPECT_LT((here.v_W - x.body.v_W).norm(), 1e-3 * h * at_start.v_dot_W.norm()) << u;
      EXPECT_LT((here.x_W - x.body.x_W).norm(), 1e-4) << u;
      EXPECT_LT((within.rate(u).f_B - now.f_B).norm(), 0.03 * (changes + 0.1)) << u;
      for (std::size_t n = 0; n < vehicle.rotors.size(); ++n)
        EXPECT_NEAR(within.speed(u, n), x.motors[n].Omega, 1e-3 * x.motors[n].Omega) << u;
    }
  }
}

// Erratum 7: what no flight log can tell.
TEST(Laws, ScalingMassInertiaAndRotorConstantsTogetherChangesNoMotion) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    const std::vector<double> p = parameter_vector(vehicle);
    std::vector<double> scaled = p;
    for (const int i : {param::m, param::kT, param::kQ, param::Jxx, param::Jyy, param::Jzz, param::Jp})
      scaled[static_cast<std::size_t>(i)] *= 1.7;
    const FlightInputs inputs = restless_commands(vehicle.rotors.size());
    const FlightState<double> start = moving_state(p, vehicle.rotors.size());
    const FlightState<double> usual = flown(vehicle, p, inputs, start, 2e-3);
    expect_same_motion(usual, flown(vehicle, scaled, inputs, start, 2e-3), vehicle.name);
    scaled[param::kT] /= 1.001;  // without it the scaling would be seen
    EXPECT_GT((usual.body.v_W - flown(vehicle, scaled, inputs, start, 2e-3).body.v_W).norm(), 1e-4);
  }
}

// Erratum 7: without measured rotor speeds.
TEST(Laws, ScalingTheMotorGainAgainstTheRotorConstantsChangesNoMotion) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    const std::vector<double> p = parameter_vector(vehicle);
    const double c = 1.3;
    std::vector<double> scaled = p;
    scaled[param::km] *= c, scaled[param::Jp] /= c;
    scaled[param::kT] /= c * c, scaled[param::kQ] /= c * c;
    const FlightInputs inputs = restless_commands(vehicle.rotors.size());
    const FlightState<double> a = flown(vehicle, p, inputs, moving_state(p, vehicle.rotors.size()), 2e-3);
    const FlightState<double> b =
        flown(vehicle, scaled, inputs, moving_state(scaled, vehicle.rotors.size()), 2e-3);
    expect_same_motion(a, b, vehicle.name);
    EXPECT_NEAR(b.motors[0].Omega, c * a.motors[0].Omega, 1e-9 * a.motors[0].Omega);
  }
}

Vector mirrored(const Vector& polar) { return {polar[0], -polar[1], polar[2]}; }
Vector mirrored_axial(const Vector& axial) { return {-axial[0], axial[1], -axial[2]}; }
Vec4<double> mirrored(const Vec4<double>& q) { return {q[0], -q[1], q[2], -q[3]}; }

/// Left and right exchanged: positions and axes reflected, spins reversed.
Vehicle mirrored(Vehicle vehicle) {
  for (Rotor& rotor : vehicle.rotors) {
    rotor.r_B = mirrored(rotor.r_B), rotor.a_B = mirrored(rotor.a_B), rotor.slant_B = mirrored(rotor.slant_B);
    rotor.s = -rotor.s;
  }
  return vehicle;
}

FlightState<double> mirrored(FlightState<double> x) {
  x.body = {mirrored(x.body.q_WB), mirrored_axial(x.body.w_B), mirrored(x.body.v_W), mirrored(x.body.x_W)};
  return x;
}

TEST(Laws, MirroredVehicleFliesTheMirroredMotion) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    const std::vector<double> p = parameter_vector(vehicle);
    const FlightInputs inputs = restless_commands(vehicle.rotors.size());
    const FlightState<double> start = moving_state(p, vehicle.rotors.size());
    expect_same_motion(mirrored(flown(vehicle, p, inputs, start, 2e-3)),
                       flown(mirrored(vehicle), p, inputs, mirrored(start), 2e-3), vehicle.name);
  }
}

TEST(Laws, HeadingAtTheStartTurnsTheMotionAndChangesNothingElse) {
  const Vec4<double> turn(std::cos(0.6), 0, 0, std::sin(0.6));
  const Mat3<double> R = rotation(turn);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    const std::vector<double> p = parameter_vector(vehicle);
    const auto turned = [&](FlightState<double> x) {
      x.body = {quaternion_product(turn, x.body.q_WB), x.body.w_B, R * x.body.v_W, R * x.body.x_W};
      return x;
    };
    const FlightInputs inputs = restless_commands(vehicle.rotors.size());
    const FlightState<double> start = moving_state(p, vehicle.rotors.size());
    expect_same_motion(turned(flown(vehicle, p, inputs, start, 2e-3)),
                       flown(vehicle, p, inputs, turned(start), 2e-3), vehicle.name);
  }
}

// [Selby]: drag linear in the velocity over the ground, each world axis with a constant of its own.
TEST(Laws, LinearDragActsAlongTheWorldAxesWhateverTheAttitude) {
  Vehicle vehicle = random_vehicle(2);
  vehicle.parameters["Kdx"] = {0.1, {}}, vehicle.parameters["Kdy"] = {0.2, {}},
  vehicle.parameters["Kdz"] = {0.3, {}};
  const std::vector<double> p = parameter_vector(vehicle);
  const NoEffects none;
  const Body<double> body(vehicle, p, none);
  const FlightState<double> x = moving_state(p, vehicle.rotors.size());
  const std::vector<MotorState<double>> still(vehicle.rotors.size(), {0.0, 0.0});
  const Vector drag_W = rotation(x.body.q_WB) * body.wrench(x.body, rotation(x.body.q_WB), still).F_B;
  EXPECT_LT((drag_W + Vector(0.1 * 1.0, 0.2 * 2.0, 0.3 * -0.5)).norm(), 1e-14);
}

}  // namespace
}  // namespace ident
