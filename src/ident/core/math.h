// Small mathematics on any scalar (double, Jet, Dual) with derivatives that stay finite at rest.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <type_traits>

namespace ident {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class S>
using Vec3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Vec4 = Eigen::Matrix<S, 4, 1>;
template <class S>
using Mat3 = Eigen::Matrix<S, 3, 3>;

/// The plain number inside a scalar: the value part of a Jet (`a`) or Dual (`v`).
template <class S>
double value(const S& x) {
  if constexpr (std::is_arithmetic_v<S>)
    return static_cast<double>(x);
  else if constexpr (requires { x.a; })
    return x.a;
  else
    return x.v;
}

/// Is a scalar's derivative zero in every direction?
template <class S>
bool is_constant(const S& x) {
  if constexpr (std::is_arithmetic_v<S>)
    return true;
  else if constexpr (requires { x.a; })
    return x.v.isZero(0);
  else
    return x.is_constant();
}

/// Is a scalar zero together with all its derivatives? Then what it multiplies need not be computed.
template <class S>
bool is_identically_zero(const S& x) {
  return value(x) == 0 && is_constant(x);
}

/// a + h b, the step of every integrator.
inline double sum(double a, double h, double b) { return a + h * b; }
template <class S>
S sum(const S& a, double h, const S& b) {
  return a + h * b;
}

template <class S, int N>
Eigen::Matrix<S, N, 1> sum(const Eigen::Matrix<S, N, 1>& a, double h, const Eigen::Matrix<S, N, 1>& b) {
  Eigen::Matrix<S, N, 1> r;
  for (int i = 0; i < N; ++i) r[i] = sum(a[i], h, b[i]);
  return r;
}

/// Length of a vector, rounded off below `floor` so that its derivative is finite at zero.
template <class S>
S norm(const Vec3<S>& v, double floor = 1e-6) {
  using std::sqrt;
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + floor * floor);
}

/// Cross product of vectors of possibly different scalars (a constant arm times an estimated force).
template <class A, class B>
auto cross(const Vec3<A>& a, const Vec3<B>& b) {
  using S = decltype(A() * B());
  return Vec3<S>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

template <class A, class B>
auto dot(const Vec3<A>& a, const Vec3<B>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Rotation matrix of a unit quaternion (w, x, y, z), body to world for q_WB.
template <class S>
Mat3<S> rotation(const Vec4<S>& q) {
  const S w = q[0], x = q[1], y = q[2], z = q[3];
  const S xx = x * x, yy = y * y, zz = z * z, xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y,
          wz = w * z;
  Mat3<S> R;
  R(0, 0) = 1.0 - 2.0 * (yy + zz), R(0, 1) = 2.0 * (xy - wz), R(0, 2) = 2.0 * (xz + wy);
  R(1, 0) = 2.0 * (xy + wz), R(1, 1) = 1.0 - 2.0 * (xx + zz), R(1, 2) = 2.0 * (yz - wx);
  R(2, 0) = 2.0 * (xz - wy), R(2, 1) = 2.0 * (yz + wx), R(2, 2) = 1.0 - 2.0 * (xx + yy);
  return R;
}

/// Hamilton product a * b.
template <class A, class B>
auto quaternion_product(const Vec4<A>& a, const Vec4<B>& b) {
  using S = decltype(A() * B());
  return Vec4<S>(a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
                 a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                 a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
                 a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]);
}

template <class S>
Vec4<S> conjugate(const Vec4<S>& q) {
  return Vec4<S>(q[0], -q[1], -q[2], -q[3]);
}

/// Unit quaternion of a rotation vector, for |d| well below pi; first and second order exact at zero.
inline Eigen::Vector4d quaternion_from_rotation_vector(const Eigen::Vector3d& d) {
  const double angle = d.norm();
  const double s = angle > 1e-8 ? std::sin(angle / 2) / angle : 0.5 - angle * angle / 48;
  return {std::cos(angle / 2), s * d[0], s * d[1], s * d[2]};
}

/// The other way round: the rotation vector of a unit quaternion, no longer than pi.
inline Eigen::Vector3d rotation_vector_from_quaternion(const Eigen::Vector4d& q) {
  const Eigen::Vector3d v(q[1], q[2], q[3]);
  const double s = v.norm(), c = std::abs(q[0]), sign = q[0] < 0 ? -1.0 : 1.0;
  return s < 1e-9 ? Eigen::Vector3d(2.0 * sign * v) : Eigen::Vector3d(sign * 2.0 * std::atan2(s, c) / s * v);
}

/// Inverse of a 3x3 matrix by cofactors: no pivoting, so that it is smooth; for well-conditioned matrices.
template <class S>
Mat3<S> inverse(const Mat3<S>& A) {
  Mat3<S> C;
  C(0, 0) = A(1, 1) * A(2, 2) - A(1, 2) * A(2, 1);
  C(0, 1) = A(0, 2) * A(2, 1) - A(0, 1) * A(2, 2);
  C(0, 2) = A(0, 1) * A(1, 2) - A(0, 2) * A(1, 1);
  C(1, 0) = A(1, 2) * A(2, 0) - A(1, 0) * A(2, 2);
  C(1, 1) = A(0, 0) * A(2, 2) - A(0, 2) * A(2, 0);
  C(1, 2) = A(0, 2) * A(1, 0) - A(0, 0) * A(1, 2);
  C(2, 0) = A(1, 0) * A(2, 1) - A(1, 1) * A(2, 0);
  C(2, 1) = A(0, 1) * A(2, 0) - A(0, 0) * A(2, 1);
  C(2, 2) = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0);
  const S determinant = A(0, 0) * C(0, 0) + A(0, 1) * C(1, 0) + A(0, 2) * C(2, 0);
  for (int i = 0; i < 9; ++i) C.data()[i] = C.data()[i] / determinant;
  return C;
}

}  // namespace ident
