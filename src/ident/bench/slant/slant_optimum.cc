// Closed form, its uncertainty, and the least-squares optimum of the slant angle.
#include "ident/bench/slant/slant_optimum.h"

#include <cmath>
#include <numbers>

#include "ident/bench/slant/slant_allocation.h"
#include "ident/core/math.h"

namespace ident {
namespace {

/// Moments of the four inputs over l t, with the wanted ones (roll about x, and so on) struck out.
Eigen::Matrix<double, 3, 4> unwanted_moments(const Vehicle& vehicle, double arm, double alpha) {
  Eigen::Matrix<double, 3, 4> M = input_allocation(vehicle, alpha).bottomRows<3>() / arm;
  for (int axis = 0; axis < 3; ++axis) M(axis, axis + 1) = 0.0;
  return M;
}

}  // namespace

double optimal_slant(double kT, double kQ, double arm) { return std::atan(2.0 * kQ / (arm * kT)); }  // (1)

double optimal_slant_std(const Known& kT, const Known& kQ, const Known& arm, double correlation) {
  if (!kT.std || !kQ.std) return kNaN;
  // alpha = atan(x), d alpha = x/(1 + x^2) d(log kQ - log kT - log l)
  const double x = 2.0 * kQ.value / (arm.value * kT.value);
  const double u = *kT.std / kT.value, v = *kQ.std / kQ.value, w = arm.std.value_or(0.0) / arm.value;
  return x / (1.0 + x * x) * std::sqrt(u * u + v * v - 2.0 * correlation * u * v + w * w);
}

double best_slant(const Vehicle& vehicle, double arm) {
  constexpr double one = std::numbers::pi / 4;  // x = 1
  const Eigen::Matrix<double, 3, 4> M0 = unwanted_moments(vehicle, arm, 0.0);
  const Eigen::Matrix<double, 3, 4> M1 = unwanted_moments(vehicle, arm, one) - M0;
  return std::atan(-(M0.array() * M1.array()).sum() / M1.squaredNorm());  // (2)
}

double unwanted_moment(const Vehicle& vehicle, double arm, double alpha) {
  constexpr double rounding = 1e-12;  // of moments that are of size 1
  const double size = unwanted_moments(vehicle, arm, alpha).norm();
  return size < rounding ? 0.0 : size;
}

}  // namespace ident
