// The Euler-Lagrange form of [Lozano]: a second derivation of the rotation, independent of Newton-Euler.
//
//   eta = (psi, theta, phi) ,   w_B = W(eta) eta' ,   M(eta) = W^T J W                                 (1)
//   M(eta) eta'' + C(eta, eta') eta' = tau ,   tau = W^T M_B                                           (2)
//   C_kj = sum_i (dM_kj/deta_i + dM_ki/deta_j - dM_ij/deta_k)/2 eta_i'      Christoffel symbols        (3)
//
// Departures from [Lozano]: the generalised torque is W^T M_B and not the body torques (erratum 6); C is
// built from Christoffel symbols, whose factors differ from the printed ones while C eta' is the same. Frames
// are FRD and NED, the angles ZYX. M is singular at theta = +-pi/2: det M = det J cos^2(theta).
#pragma once

#include <array>

#include "ident/core/math.h"

namespace ident {

/// eta = (psi, theta, phi), rad, and its derivative.
struct EulerAngles {
  Vec3<double> eta, eta_dot;
};

/// W of (1).
Mat3<double> rate_map(const Vec3<double>& eta);
/// Its derivative along eta', so that w_B' = W eta'' + W' eta'.
Mat3<double> rate_map_dot(const Vec3<double>& eta, const Vec3<double>& eta_dot);

/// Body to world as R_z(psi) R_y(theta) R_x(phi).
Mat3<double> rotation_of(const Vec3<double>& eta);

/// M of (1), its derivative along eta', and C of (3); J in kg m^2.
Mat3<double> generalised_inertia(const Mat3<double>& J, const Vec3<double>& eta);
Mat3<double> generalised_inertia_dot(const Mat3<double>& J, const EulerAngles& state);
Mat3<double> coriolis_matrix(const Mat3<double>& J, const EulerAngles& state);

/// eta'' of (2) under a moment about the centre of gravity, N m in the body frame.
Vec3<double> angular_acceleration(const Mat3<double>& J, const EulerAngles& state, const Vec3<double>& M_B);

}  // namespace ident
