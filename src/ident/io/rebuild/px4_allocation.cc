// The matrix of PX4's control allocation.
#include "ident/io/rebuild/px4_allocation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

constexpr int kMostRotors = 12;
constexpr double kActs = 1e-3;  // of an entry of the mix; PX4 takes smaller ones as none

Eigen::MatrixXd effectiveness(const LogStreams& log, int rotors) {
  Eigen::MatrixXd B(6, rotors);
  for (int n = 0; n < rotors; ++n) {
    const auto value = [&](const char* what, double otherwise) {
      return log.parameter(fmt::format("CA_ROTOR{}_{}", n, what)).value_or(otherwise);
    };
    const Eigen::Vector3d r(value("PX", 0), value("PY", 0), value("PZ", 0));
    const Eigen::Vector3d a =
        Eigen::Vector3d(value("AX", 0), value("AY", 0), value("AZ", -1)).stableNormalized();
    const double CT = value("CT", 6.5), KM = value("KM", 0.05);
    B.col(n) << CT * r.cross(a) - CT * KM * a, CT * a;
  }
  return B;
}

/// sqrt(sum of squares over half the motors that act); 1 where none does.
double torque_scale(const Eigen::VectorXd& column) {
  const auto acting = (column.array().abs() > kActs).count();
  return acting == 0 ? 1.0 : std::sqrt(column.squaredNorm() / (static_cast<double>(acting) / 2.0));
}

double thrust_scale(const Eigen::VectorXd& column) {
  constexpr double kSmallest = 1.1920929e-7;  // FLT_EPSILON
  const auto acting = (column.array().abs() > kSmallest).count();
  return acting == 0 ? 0.0 : column.cwiseAbs().sum() / static_cast<double>(acting);
}

void divide(Eigen::MatrixXd& mix, int column, double by) {
  if (by > 0) mix.col(column) /= by;
}

}  // namespace

std::optional<Eigen::MatrixXd> px4_mix(const LogStreams& log) {
  const int rotors = log.whole_parameter("CA_ROTOR_COUNT").value_or(0);
  if (rotors < 3 || rotors > kMostRotors) return std::nullopt;
  const Eigen::MatrixXd B = effectiveness(log, rotors);
  if (!B.allFinite()) return std::nullopt;
  Eigen::MatrixXd mix = B.completeOrthogonalDecomposition().pseudoInverse();
  const double torque = std::max(torque_scale(mix.col(0)), torque_scale(mix.col(1)));
  const double vertical = thrust_scale(mix.col(5));
  divide(mix, 0, torque);
  divide(mix, 1, torque);
  divide(mix, 2, mix.col(2).maxCoeff());
  for (int axis : {3, 4}) {
    const double own = thrust_scale(mix.col(axis));
    divide(mix, axis, own > 0 ? own : vertical);
  }
  divide(mix, 5, vertical);
  mix = (mix.array().abs() < kActs).select(0.0, mix);
  return mix;
}

double px4_command(double thrust, double f) {
  if (!(f > 0) || f > 1 || !(thrust > 0)) return thrust;
  const double half = (1 - f) / (2 * f);
  return std::sqrt(half * half + thrust / f) - half;
}

}  // namespace ident
