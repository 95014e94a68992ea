// The second derivation against the first, and the properties that [Lozano] states of it.
#include "ident/model/euler_lagrange.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "ident/core/random.h"
#include "ident/effects/catalogue.h"
#include "ident/model/body.h"
#include "support/random_vehicle.h"

namespace ident {
namespace {

Vec3<double> random_vector(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

EulerAngles random_angles(Random& random) {
  return {{random.uniform(-3.1, 3.1), random.uniform(-1.4, 1.4), random.uniform(-3.1, 3.1)},
          random_vector(random, 6.0)};
}

Mat3<double> random_inertia(Random& random) {
  const Mat3<double> A = Mat3<double>::NullaryExpr([&] { return random.uniform(-1.0, 1.0); });
  return A * A.transpose() + 0.5 * Mat3<double>::Identity();
}

Vec4<double> quaternion_of(const Vec3<double>& eta) {
  const Eigen::Quaterniond q(rotation_of(eta));
  return {q.w(), q.x(), q.y(), q.z()};
}

// [Lozano], as reprinted since with phi, theta, psi as the order of rows and columns.
Mat3<double> printed_coriolis(double Ix, double Iy, double Iz, const EulerAngles& s) {
  const double dpsi = s.eta_dot[0], dtheta = s.eta_dot[1], dphi = s.eta_dot[2];
  const double St = std::sin(s.eta[1]), Ct = std::cos(s.eta[1]), Sp = std::sin(s.eta[2]),
               Cp = std::cos(s.eta[2]);
  Mat3<double> C;
  C(0, 0) = 0.0;
  C(0, 1) =
      (Iy - Iz) * (dtheta * Cp * Sp + dpsi * Sp * Sp * Ct) + (Iz - Iy) * dpsi * Cp * Cp * Ct - Ix * dpsi * Ct;
  C(0, 2) = (Iz - Iy) * dpsi * Cp * Sp * Ct * Ct;
  C(1, 0) = -C(0, 1);
  C(1, 1) = (Iz - Iy) * dphi * Cp * Sp;
  C(1, 2) = -Ix * dpsi * St * Ct + Iy * dpsi * Sp * Sp * St * Ct + Iz * dpsi * Cp * Cp * St * Ct;
  C(2, 0) = (Iy - Iz) * dpsi * Ct * Ct * Sp * Cp - Ix * dtheta * Ct;
  C(2, 1) =
      (Iz - Iy) * (dtheta * Cp * Sp * St + dphi * Sp * Sp * Ct) + (Iy - Iz) * dphi * Cp * Cp * Ct - C(1, 2);
  C(2, 2) = (Iy - Iz) * dphi * Cp * Sp * Ct * Ct - Iy * dtheta * Sp * Sp * Ct * St -
            Iz * dtheta * Cp * Cp * Ct * St + Ix * dtheta * Ct * St;
  return C.reverse();  // to the order psi, theta, phi
}

TEST(EulerLagrange, InertiaMinusTwiceCoriolisIsSkew) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Mat3<double> J = random_inertia(random);
    const EulerAngles state = random_angles(random);
    const Mat3<double> N = generalised_inertia_dot(J, state) - 2.0 * coriolis_matrix(J, state);
    EXPECT_LT((N + N.transpose()).norm(), 1e-12 * N.norm());
    EXPECT_GT(N.norm(), 0.1);
  }
}

TEST(EulerLagrange, DeterminantIsThatOfTheInertiaTimesTheSquaredCosineOfPitch) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const double Ixx = random.uniform(0.5, 2.0), Iyy = random.uniform(0.5, 2.0),
                 Izz = random.uniform(0.5, 2.0);
    const Vec3<double> eta = random_angles(random).eta;
    const Mat3<double> J = Vec3<double>(Ixx, Iyy, Izz).asDiagonal();
    const double cosine = std::cos(eta[1]);
    EXPECT_NEAR(generalised_inertia(J, eta).determinant(), Ixx * Iyy * Izz * cosine * cosine, 1e-13);
  }
}

TEST(EulerLagrange, InertiaDotIsTheDerivativeOfTheInertia) {
  Random random(3);
  const double h = 1e-5;
  for (int i = 0; i < 20; ++i) {
    const Mat3<double> J = random_inertia(random);
    const EulerAngles s = random_angles(random);
    const Mat3<double> numeric =
        (generalised_inertia(J, s.eta + h * s.eta_dot) - generalised_inertia(J, s.eta - h * s.eta_dot)) /
        (2 * h);
    EXPECT_LT((generalised_inertia_dot(J, s) - numeric).norm(), 1e-7 * numeric.norm());
  }
}

TEST(EulerLagrange, PrintedCoriolisMatrixGivesTheSameForceByOtherFactors) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const double Ix = random.uniform(0.5, 2.0), Iy = random.uniform(0.5, 2.0), Iz = random.uniform(0.5, 2.0);
    const Mat3<double> J = Vec3<double>(Ix, Iy, Iz).asDiagonal();
    const EulerAngles s = random_angles(random);
    const Mat3<double> ours = coriolis_matrix(J, s), printed = printed_coriolis(Ix, Iy, Iz, s);
    EXPECT_LT((ours * s.eta_dot - printed * s.eta_dot).norm(),
              1e-12 * (1.0 + ours.norm() * s.eta_dot.norm()));
    EXPECT_GT((ours - printed).norm(), 1e-6);
    const Mat3<double> N = generalised_inertia_dot(J, s) - 2.0 * printed;
    EXPECT_LT((N + N.transpose()).norm(), 1e-12 * N.norm());
  }
}

TEST(EulerLagrange, AccelerationsEqualThoseOfNewtonAndEulerAtRandomStates) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    Vehicle vehicle = random_vehicle(seed);
    const double Jxx = vehicle.value("Jxx");
    for (const char* name : {"Jxy", "Jxz", "Jyz"})
      vehicle.parameters[name] = {0.1 * Jxx * random.uniform(), {}};
    const std::vector<double> p = parameter_vector(vehicle);
    const NoEffects none;
    const Body<double> body(vehicle, p, none);
    const EulerAngles angles = random_angles(random);
    const BodyState<double> state{quaternion_of(angles.eta),
                                  Vec3<double>(rate_map(angles.eta) * angles.eta_dot),
                                  random_vector(random, 5.0), random_vector(random, 5.0)};
    std::vector<MotorState<double>> motors;
    for (std::size_t n = 0; n < vehicle.rotors.size(); ++n)
      motors.push_back({random.uniform(0.0, 1.0) * vehicle.value("km"), random.uniform(-1.0, 1.0) * 1e3});
    const BodyRate<double> newton = body.rate(state, motors);
    const Wrench<double> wrench = body.wrench(state, rotation(state.q_WB), motors);

    const Vec3<double> eta_ddot = angular_acceleration(body.J(), angles, wrench.M_B);
    const Vec3<double> w_dot =
        rate_map(angles.eta) * eta_ddot + rate_map_dot(angles.eta, angles.eta_dot) * angles.eta_dot;
    EXPECT_LT((newton.w_dot_B - w_dot).norm(), 1e-10 * (1.0 + w_dot.norm())) << vehicle.name;
    const Vec3<double> xi_ddot =
        rotation_of(angles.eta) * wrench.F_B / vehicle.value("m") + Vec3<double>(0, 0, vehicle.g);
    EXPECT_LT((newton.v_dot_W - xi_ddot).norm(), 1e-10 * (1.0 + xi_ddot.norm())) << vehicle.name;
  }
}

}  // namespace
}  // namespace ident
