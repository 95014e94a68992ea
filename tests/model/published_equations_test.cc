// The published equations on their own layouts against the one model, and every erratum of
// src/ident/model/README.md pinned: which side is right, and that the other is wrong.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "ident/core/random.h"
#include "ident/effects/catalogue.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/model/body.h"
#include "ident/model/dc_motor.h"
#include "ident/model/euler_lagrange.h"
#include "support/published.h"

namespace ident {
namespace {

using published::Vector;

constexpr double kThrust = 6e-6, kTorque = 8e-8, kArm = 0.17, kMass = 0.5, kSpin = 1.5e-5;

Vehicle quad(const std::string& layout, double alpha = 0.0) {
  Vehicle v;
  v.rotors = layout_rotors(layout, kArm, alpha);
  v.parameters = {{"m", {kMass, {}}},  {"kT", {kThrust, {}}}, {"kQ", {kTorque, {}}},
                  {"Jxx", {3e-3, {}}}, {"Jyy", {3.2e-3, {}}}, {"Jzz", {5e-3, {}}},
                  {"Jp", {kSpin, {}}}, {"alpha", {alpha, {}}}};
  return v;
}

/// Rotors 1 and 3 of [Selby] turn clockwise, 2 and 4 counter-clockwise; 1 front, 2 right, 3 back, 4 left.
Vehicle selby_quad() {
  Vehicle v = quad("plus");
  std::swap(v.rotors[1], v.rotors[3]);
  for (Rotor& rotor : v.rotors) rotor.s = -rotor.s;
  return v;
}

struct Case {
  Vec3<double> w_B;
  std::vector<MotorState<double>> motors;
  std::array<double, 4> Omega;
};

Case random_case(Random& random) {
  Case c{.w_B = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)},
         .motors = {},
         .Omega = {}};
  for (std::size_t n = 0; n < 4; ++n) {
    c.motors.push_back({random.uniform(100, 700), random.uniform(-2000, 2000)});
    c.Omega[n] = c.motors[n].Omega;
  }
  return c;
}

/// Force and moment of the model; without the rotors' momentum where `Jp` is 0.
Wrench<double> wrench(const Vehicle& vehicle, const Case& at, double Jp) {
  std::vector<double> p = parameter_vector(vehicle);
  p[param::Jp] = Jp;
  const NoEffects none;
  const BodyState<double> state{{1, 0, 0, 0}, at.w_B, {0, 0, 0}, {0, 0, -5}};
  return Body<double>(vehicle, p, none).wrench(state, Mat3<double>::Identity(), at.motors);
}

published::Rotors4 loads(const Case& at) {
  published::Rotors4 r{};
  for (std::size_t n = 0; n < 4; ++n)
    r.T[n] = kThrust * at.Omega[n] * at.Omega[n], r.Q[n] = kTorque * at.Omega[n] * at.Omega[n];
  return r;
}

TEST(Published, PhangsForceAndMomentAreThoseOfTheModelOnHisLayout) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const double alpha = random.uniform(-0.3, 0.3);
    const Case at = random_case(random);
    const Wrench<double> ours = wrench(quad("4sp", alpha), at, 0.0);
    EXPECT_LT((ours.F_B - published::phang_force(loads(at), alpha)).norm(), 1e-13);
    EXPECT_LT((ours.M_B - published::phang_moment(loads(at), kArm, alpha)).norm(), 1e-14);
  }
}

// The sign itself is decided by Laws.AngularMomentumOfBodyAndRotorsIsConservedWithoutExternalTorque.
TEST(Published, Erratum1PhangsRotorMomentumTermsAreTheModelsWithTheOppositeSign) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Case at = random_case(random);
    double sum = 0.0, rate = 0.0;
    for (const auto& motor : at.motors) sum += motor.Omega, rate += motor.Omega_dot;
    const Vector printed = published::phang_rotor_momentum_as_printed(kSpin, at.w_B, sum, rate);
    Vehicle vehicle = quad("4sp", 0.0);
    const auto of_momentum = [&] {
      return Vector(wrench(vehicle, at, kSpin).M_B - wrench(vehicle, at, 0.0).M_B);
    };
    EXPECT_LT((of_momentum() + printed).norm(), 1e-12);
    vehicle.signs = Signs::as_published;
    EXPECT_LT((of_momentum() - printed).norm(), 1e-12);
    EXPECT_GT(printed.norm(), 1e-6);
  }
}

TEST(Published, Erratum2PhangsTableCannotHoverAndItsInertiaIsNoBodys) {
  const Vehicle v =
      read_vehicle(std::string(IDENT_SOURCE_DIR) + "/data/published/phang_4sp.yaml", VehicleUse::judging);
  const double full = v.value("kT") * v.value("km") * v.value("km"), alpha = v.value("alpha");
  const double weight = v.value("m") * v.g;
  EXPECT_NEAR(full * (2.0 + 2.0 * std::cos(alpha)) / weight, 0.62, 0.005);
  const double Omega_hover = std::sqrt(weight / 4.0 / v.value("kT"));  // equal vertical thrust
  EXPECT_NEAR(Omega_hover, 666.0, 2.0);
  EXPECT_NEAR(Omega_hover / v.value("km"), 1.27, 0.005);
  EXPECT_LT(v.value("Jxx") + v.value("Jyy"), v.value("Jzz"));
}

TEST(Published, Erratum3TheRollInputOfThe4spPushesSidewaysWhileHeaveYawAndPitchDoNot) {
  const double alpha = 5.77 * M_PI / 180.0;
  Vehicle vehicle = quad("4sp", alpha);
  vehicle.parameters["kQ"] = {0.5 * std::tan(alpha) * kArm * kThrust, {}};  // [Phang 24]
  const double hover = kMass * 9.81 / 4.0, t = 0.2;                         // N of vertical thrust
  const auto of = [&](const std::array<double, 4>& vertical) {
    Case at{.w_B = {0, 0, 0}, .motors = {}, .Omega = {}};
    for (std::size_t n = 0; n < 4; ++n) {
      const double T = (hover + vertical[n]) / (n % 2 ? std::cos(alpha) : 1.0);
      at.motors.push_back({std::sqrt(T / kThrust), 0.0});
    }
    return wrench(vehicle, at, 0.0);
  };
  const Wrench<double> rest = of({0, 0, 0, 0}), heave = of({t, t, t, t}), roll = of({0, t, 0, -t}),
                       pitch = of({t, 0, -t, 0}), yaw = of({t, -t, t, -t});
  EXPECT_LT(rest.M_B.norm(), 1e-15);
  EXPECT_LT(heave.M_B.norm(), 1e-15);
  EXPECT_LT(Vector(0, roll.M_B[1], roll.M_B[2]).norm(), 1e-15);
  EXPECT_LT(Vector(pitch.M_B[0], 0, pitch.M_B[2]).norm(), 1e-15);
  EXPECT_LT(Vector(yaw.M_B[0], yaw.M_B[1], 0).norm(), 1e-15);
  // The thrusts' lever, and the drag torques that are tilted with them: kQ/kT = l tan(alpha)/2.
  EXPECT_NEAR(roll.M_B[0], 2 * kArm * t * (1 + 0.5 * std::tan(alpha) * std::tan(alpha)), 1e-15);
  EXPECT_NEAR(roll.F_B[0], -2 * t * std::tan(alpha), 1e-14);
  EXPECT_NEAR(2 * std::tan(alpha), 0.202, 5e-4);
  for (const auto& other : {heave, pitch, yaw})
    EXPECT_LT(std::abs(other.F_B[0]) + std::abs(other.F_B[1]), 1e-15);
}

TEST(Published, Erratum4PowerIsConservedWithAGearOnlyIfTheBackEmfTurnsWithTheMotor) {
  for (const double G : {1.0, 3.0}) {
    const DcMotor motor{.ki = 0.006, .kv = 0.006, .R = 0.2, .I0 = 0.5, .G = G};
    const double V = 9.0, Omega = 200.0, I = motor.current(V, Omega);
    const double shaft = motor.shaft_torque(I) * Omega;
    const double losses = motor.R * I * I + motor.kv * G * Omega * motor.I0;  // copper and no load
    EXPECT_NEAR(V * I, shaft + losses, 1e-12 * V * I) << G;
    // As printed: torque G Qm, but back-EMF kv Omega.
    const double printed_I = (V - motor.kv * Omega) / motor.R;
    const double printed_shaft = G * motor.ki * (printed_I - motor.I0) * Omega;
    const double printed_losses = motor.R * printed_I * printed_I + motor.kv * Omega * motor.I0;
    if (G == 1.0)
      EXPECT_NEAR(V * printed_I, printed_shaft + printed_losses, 1e-12 * V * I);
    else
      EXPECT_GT(printed_shaft + printed_losses, 1.2 * V * printed_I);  // more than is put in
  }
}

TEST(Published, Erratum4PulsesFitIntoAServoFrameOfTwentyMillisecondsAsMicrosecondsOnly) {
  const CommandRange range;  // [Phang 23]: delta = (u - 1100)/840
  EXPECT_EQ(range.min_us, 1100.0);
  EXPECT_EQ(range.max_us - range.min_us, 840.0);
  EXPECT_LT(1e-6 * range.max_us, 0.020);
  EXPECT_GT(1e-3 * range.min_us, 0.020);  // as printed: more than a second
}

TEST(Published, Erratum5SelbysRollPitchAndGyroscopicTermsAgreeHisYawTermDoesNot) {
  Random random(5);
  const Vehicle vehicle = selby_quad();
  for (int i = 0; i < 50; ++i) {
    const Case at = random_case(random);
    const Vector printed = published::selby_moment(kThrust, kTorque, kArm, at.Omega);
    const Vector ours = wrench(vehicle, at, 0.0).M_B;
    EXPECT_NEAR(ours[0], printed[0], 1e-13);
    EXPECT_NEAR(ours[1], printed[1], 1e-13);
    EXPECT_NEAR(ours[2], -printed[2], 1e-14);  // a clockwise rotor drags the body to negative yaw
    Case steady = at;
    for (auto& motor : steady.motors) motor.Omega_dot = 0.0;
    const Vector gyroscopic = wrench(vehicle, steady, kSpin).M_B - wrench(vehicle, steady, 0.0).M_B;
    EXPECT_LT((gyroscopic - published::selby_gyroscopic(kSpin, at.w_B, at.Omega)).norm(), 1e-12);
  }
}

TEST(Published, Erratum5SecondRowOfSelbysGyroscopicProductIsJxMinusJz) {
  const Vector w(1.0, 2.0, 3.0), J(1.0, 1.5, 2.2);
  const double row = cross(w, Vector(J.cwiseProduct(w)))[1];
  EXPECT_NEAR(row, (J[0] - J[2]) * w[0] * w[2], 1e-15);
  EXPECT_GT(std::abs(row - (J[2] - J[0]) * w[0] * w[2]), 1.0);  // as printed
}

TEST(Published, Erratum5ThrustIsTurnedIntoTheWorldAndAngleRatesAreNotBodyRates) {
  const Vehicle vehicle = quad("plus");
  const std::vector<double> p = parameter_vector(vehicle);
  const NoEffects none;
  const Vector eta(0.0, 0.3, 0.2);
  const Eigen::Quaterniond q(rotation_of(eta));
  const BodyState<double> state{{q.w(), q.x(), q.y(), q.z()}, {0, 0, 0}, {0, 0, 0}, {0, 0, -5}};
  const std::vector<MotorState<double>> motors(4, {450.0, 0.0});
  const double T = 4 * kThrust * 450.0 * 450.0;
  const Vector a_W = Body<double>(vehicle, p, none).rate(state, motors).v_dot_W;
  EXPECT_LT((a_W - Vector(Vector(0, 0, 9.81) - rotation_of(eta) * Vector(0, 0, T / kMass))).norm(), 1e-13);
  EXPECT_GT(std::hypot(a_W[0], a_W[1]), 1.0);  // without R: zero
  const Vector rates(0.5, 0.4, 0.3);           // psi', theta', phi'
  EXPECT_GT((rate_map(eta) * rates - Vector(rates.reverse())).norm(), 0.1);
  EXPECT_LT((rate_map(Vector::Zero()) * rates - Vector(rates.reverse())).norm(), 1e-15);  // level only
}

TEST(Published, Erratum5SelbysMotorPowerWithAllItsFactorsIsVoltageTimesCurrent) {
  const DcMotor motor{.ki = 0.006, .kv = 0.0065, .R = 0.2, .I0 = 0.5};
  const double V = 9.0, Omega = 700.0, I = motor.current(V, Omega);
  const double power =
      published::selby_power(motor.shaft_torque(I), Omega, motor.ki, motor.kv, motor.R, motor.I0);
  EXPECT_NEAR(power, V * I, 1e-12 * V * I);
}

TEST(Published, Erratum6LozanosRotationNeedsSinePsiCosineTheta) {
  const double psi = 0.7, theta = 0.4, phi = -0.3;
  const auto off_orthogonal = [](const Mat3<double>& R) {
    return (R * R.transpose() - Mat3<double>::Identity()).norm();
  };
  const Mat3<double> printed = published::lozano_rotation(psi, theta, phi, std::sin(psi) * std::sin(theta));
  const Mat3<double> right = published::lozano_rotation(psi, theta, phi, std::sin(psi) * std::cos(theta));
  EXPECT_GT(off_orthogonal(printed), 0.1);
  EXPECT_LT(off_orthogonal(right), 1e-15);
  // Even so it carries world into body; F = R (0,0,u) needs body into world and loses the heading otherwise.
  EXPECT_LT((right.transpose() - rotation_of({psi, theta, phi})).norm(), 1e-15);
  const Vector up(0, 0, 1);
  const Mat3<double> turned =
      published::lozano_rotation(psi + 1.0, theta, phi, std::sin(psi + 1.0) * std::cos(theta));
  EXPECT_LT((right * up - turned * up).norm(), 1e-15);
  EXPECT_GT((right.transpose() * up - turned.transpose() * up).norm(), 0.1);
}

TEST(Published, Erratum6GeneralisedTorqueIsThatOfTheAnglesNotOfTheBodyAxes) {
  const Mat3<double> J = Vector(3e-3, 3.2e-3, 5e-3).asDiagonal();
  const EulerAngles state{{0.2, 0.5, -0.4}, {0.3, -0.2, 0.6}};
  const Vector M_B(0.01, -0.02, 0.005), w = rate_map(state.eta) * state.eta_dot;
  const Vector w_dot = J.inverse() * (M_B - cross(w, Vector(J * w)));
  const auto of = [&](const Vector& tau) {
    const Vector rest = tau - coriolis_matrix(J, state) * state.eta_dot;
    const Vector eta_ddot = generalised_inertia(J, state.eta).inverse() * rest;
    return Vector(rate_map(state.eta) * eta_ddot + rate_map_dot(state.eta, state.eta_dot) * state.eta_dot);
  };
  EXPECT_LT((of(rate_map(state.eta).transpose() * M_B) - w_dot).norm(), 1e-11);
  EXPECT_GT((of(Vector(M_B.reverse())) - w_dot).norm(), 0.1);  // body torques in the order psi, theta, phi
}

TEST(Published, Erratum6GravityAcceleratesEveryMassAlikeAndAFrontRotorPitchesTheNoseUp) {
  const NoEffects none;
  const BodyState<double> state{{1, 0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, -5}};
  const std::vector<MotorState<double>> still(4, {0.0, 0.0});
  for (const double m : {0.1, 3.0}) {  // (28) divides g by m
    Vehicle vehicle = quad("plus");
    vehicle.parameters["m"] = {m, {}};
    const std::vector<double> p = parameter_vector(vehicle);
    EXPECT_EQ(Body<double>(vehicle, p, none).rate(state, still).v_dot_W[2], 9.81);
  }
  // (21), (22): more thrust in front pitches, more thrust on the left rolls to the right.
  Case front{.w_B = {0, 0, 0}, .motors = {{500, 0}, {450, 0}, {450, 0}, {450, 0}}, .Omega = {}};
  Case left{.w_B = {0, 0, 0}, .motors = {{450, 0}, {500, 0}, {450, 0}, {450, 0}}, .Omega = {}};
  const Vector M_front = wrench(quad("plus"), front, 0.0).M_B, M_left = wrench(quad("plus"), left, 0.0).M_B;
  EXPECT_GT(M_front[1], 0.0);
  EXPECT_NEAR(M_front[0], 0.0, 1e-15);
  EXPECT_GT(M_left[0], 0.0);
  EXPECT_NEAR(M_left[1], 0.0, 1e-15);
  // (20): a counter-clockwise rotor turns the body clockwise, to positive yaw about z down.
  EXPECT_GT(M_front[2], 0.0);
  EXPECT_LT(M_left[2], 0.0);
}

}  // namespace
}  // namespace ident
