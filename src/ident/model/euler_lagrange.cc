// W(eta), its derivatives, and what follows from them.
#include "ident/model/euler_lagrange.h"

#include <Eigen/Dense>

namespace ident {
namespace {

/// dW/deta_i for i = psi, theta, phi.
std::array<Mat3<double>, 3> rate_map_slopes(const Vec3<double>& eta) {
  const double st = std::sin(eta[1]), ct = std::cos(eta[1]), sp = std::sin(eta[2]), cp = std::cos(eta[2]);
  Mat3<double> by_theta, by_phi;
  by_theta << -ct, 0, 0,  //
      -st * sp, 0, 0,     //
      -st * cp, 0, 0;
  by_phi << 0, 0, 0,    //
      ct * cp, -sp, 0,  //
      -ct * sp, -cp, 0;
  return {Mat3<double>::Zero(), by_theta, by_phi};
}

/// dM/deta_i.
std::array<Mat3<double>, 3> inertia_slopes(const Mat3<double>& J, const Vec3<double>& eta) {
  const Mat3<double> W = rate_map(eta);
  std::array<Mat3<double>, 3> slopes = rate_map_slopes(eta);
  for (Mat3<double>& slope : slopes) slope = (slope.transpose() * J * W + W.transpose() * J * slope).eval();
  return slopes;
}

Mat3<double> along(const std::array<Mat3<double>, 3>& slopes, const Vec3<double>& eta_dot) {
  return slopes[0] * eta_dot[0] + slopes[1] * eta_dot[1] + slopes[2] * eta_dot[2];
}

}  // namespace

Mat3<double> rate_map(const Vec3<double>& eta) {
  const double st = std::sin(eta[1]), ct = std::cos(eta[1]), sp = std::sin(eta[2]), cp = std::cos(eta[2]);
  Mat3<double> W;
  W << -st, 0, 1,      //
      ct * sp, cp, 0,  //
      ct * cp, -sp, 0;
  return W;
}

Mat3<double> rate_map_dot(const Vec3<double>& eta, const Vec3<double>& eta_dot) {
  return along(rate_map_slopes(eta), eta_dot);
}

Mat3<double> rotation_of(const Vec3<double>& eta) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(eta[0], Vector3d::UnitZ()) * AngleAxisd(eta[1], Vector3d::UnitY()) *
          AngleAxisd(eta[2], Vector3d::UnitX()))
      .toRotationMatrix();
}

Mat3<double> generalised_inertia(const Mat3<double>& J, const Vec3<double>& eta) {
  const Mat3<double> W = rate_map(eta);
  return W.transpose() * J * W;  // (1)
}

Mat3<double> generalised_inertia_dot(const Mat3<double>& J, const EulerAngles& state) {
  return along(inertia_slopes(J, state.eta), state.eta_dot);
}

Mat3<double> coriolis_matrix(const Mat3<double>& J, const EulerAngles& state) {
  const std::array<Mat3<double>, 3> dM = inertia_slopes(J, state.eta);
  Mat3<double> C = Mat3<double>::Zero();
  const auto slope = [&](int k, int j, int i) { return dM[static_cast<std::size_t>(i)](k, j); };
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        C(k, j) += 0.5 * (slope(k, j, i) + slope(k, i, j) - slope(i, j, k)) * state.eta_dot[i];  // (3)
  return C;
}

Vec3<double> angular_acceleration(const Mat3<double>& J, const EulerAngles& state, const Vec3<double>& M_B) {
  const Vec3<double> tau = rate_map(state.eta).transpose() * M_B;
  const Vec3<double> rest = tau - coriolis_matrix(J, state) * state.eta_dot;
  return generalised_inertia(J, state.eta).ldlt().solve(rest);  // (2)
}

}  // namespace ident
