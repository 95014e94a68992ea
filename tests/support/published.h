// Force and moment as three sources print them, each on its own layout and in its own symbols; for tests
// only.
//
//   [Phang 14, 15]  4SP: front, left, back, right, all counter-clockwise, left and right slanted by alpha
//   [Selby]         plus, NED: front, right, back, left; rotors 1 and 3 clockwise by his own statement
//   [Lozano]        plus, z up: front, right, back, left
//
// Written out by hand from what src/ident/model/README.md cites of the sources, which are not at hand; where
// a source is in error both the printed and the corrected form stand here, by name.
#pragma once

#include <array>
#include <cmath>

#include "ident/core/math.h"

namespace ident::published {

using Vector = Vec3<double>;

/// Thrust T, N, and drag torque Q, N m, of rotors 1 to 4.
struct Rotors4 {
  std::array<double, 4> T, Q;
};

/// [Phang 14], body frame.
inline Vector phang_force(const Rotors4& r, double alpha) {
  return {(r.T[3] - r.T[1]) * std::sin(alpha), 0.0, -r.T[0] - r.T[2] - (r.T[1] + r.T[3]) * std::cos(alpha)};
}

/// [Phang 15], body frame; l is the arm.
inline Vector phang_moment(const Rotors4& r, double l, double alpha) {
  const double sa = std::sin(alpha), ca = std::cos(alpha);
  return {l * (r.T[1] - r.T[3]) * ca + (r.Q[1] - r.Q[3]) * sa, l * (r.T[0] - r.T[2]),
          r.Q[0] + r.Q[2] + (r.Q[1] + r.Q[3]) * ca - l * (r.T[1] + r.T[3]) * sa};
}

/// [Phang 16, 18, 19] as printed: reaction and gyroscopic torque of equal rotors with momentum Jp Omega about
/// body z downwards, as if they turned clockwise.
inline Vector phang_rotor_momentum_as_printed(double Jp, const Vector& w, double sum_Omega, double sum_rate) {
  return Vector(0, 0, -Jp * sum_rate) - cross(w, Vector(0, 0, Jp * sum_Omega));
}

/// [Selby]: moment in NED with k_t, k_d per squared speed; the yaw row as printed.
inline Vector selby_moment(double kt, double kd, double l, const std::array<double, 4>& w) {
  const auto square = [](double v) { return v * v; };
  return {l * kt * (square(w[3]) - square(w[1])), l * kt * (square(w[0]) - square(w[2])),
          kd * (square(w[0]) - square(w[1]) + square(w[2]) - square(w[3]))};
}

/// [Selby]: gyroscopic moment with Omega_r = w1 - w2 + w3 - w4.
inline Vector selby_gyroscopic(double Jr, const Vector& pqr, const std::array<double, 4>& w) {
  const double Omega_r = w[0] - w[1] + w[2] - w[3];
  return {-Jr * pqr[1] * Omega_r, Jr * pqr[0] * Omega_r, 0.0};
}

/// [Selby]: motor power with every factor of Kt in its place.
inline double selby_power(double tau, double w, double Kt, double Kv, double R, double I0) {
  return (tau + Kt * I0) * (Kt * I0 * R + tau * R + Kt * Kv * w) / (Kt * Kt);
}

/// [Lozano]: rotation as printed with `entry` in place of element (1,2): s_psi s_theta printed, s_psi c_theta
/// right. It carries world into body.
inline Mat3<double> lozano_rotation(double psi, double theta, double phi, double entry) {
  const double cs = std::cos(psi), ss = std::sin(psi), ct = std::cos(theta), st = std::sin(theta),
               cp = std::cos(phi), sp = std::sin(phi);
  Mat3<double> R;
  R << ct * cs, entry, -st,                                     //
      cs * st * sp - ss * cp, ss * st * sp + cs * cp, ct * sp,  //
      cs * st * cp + ss * sp, ss * st * cp - cs * sp, ct * cp;
  return R;
}

}  // namespace ident::published
