// The triangle inequality of the moments of inertia, tested with the covariance of the fit, and the
// projection onto it.
#include "ident/flight/fit/physical_inertia.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "ident/core/format_number.h"

namespace ident {
namespace {

// Violations below so many standard deviations are chance, in a body that is nearly flat.
constexpr double kByChanceInertia = 2.0;

// A second moment of mass below this share of their sum counts as zero.
constexpr double kFlat = 1e-9;
constexpr int kMostRounds = 50;

// Second moments of mass, integral r r' dm, of the inertia at u.
Eigen::Matrix3d second_moments(const Theta& theta, const Eigen::VectorXd& u) {
  const Eigen::Matrix3d J = theta.inertia(u);
  return 0.5 * J.trace() * Eigen::Matrix3d::Identity() - J;
}

// The least second moment over the sum of all, and its derivative over the unknowns by central differences.
struct Least {
  double share = 0.0;
  Eigen::VectorXd slope;
};
Least least_moment(const Theta& theta, const Eigen::VectorXd& u) {
  constexpr double kStep = 1e-6;
  const Eigen::Matrix3d S = second_moments(theta, u);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(S);
  const Eigen::Vector3d axis = eigen.eigenvectors().col(0);
  Least out{eigen.eigenvalues()[0] / S.trace(), Eigen::VectorXd::Zero(theta.size())};
  const auto share_along = [&](const Eigen::VectorXd& at) {
    const Eigen::Matrix3d there = second_moments(theta, at);
    return axis.dot(there * axis) / there.trace();
  };
  for (int i = 0; i < theta.constants_count(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(theta.size(), i);
    out.slope[i] = (share_along(u + step) - share_along(u - step)) / (2 * kStep);
  }
  return out;
}

}  // namespace

void warn_of_inertia(Result& result, const Theta& theta, const FlightFit& fit) {
  constexpr std::array moments{param::Jxx, param::Jyy, param::Jzz};
  constexpr std::array names{"Jxx", "Jyy", "Jzz"};
  const std::vector<double> p = theta.p(fit.u);
  for (std::size_t c = 0; c < 3; ++c) {
    double margin = 0;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(theta.size());
    for (std::size_t k = 0; k < 3; ++k) {
      const double sign = k == c ? -1.0 : 1.0;
      margin += sign * p[static_cast<std::size_t>(moments[k])];
      for (int i = 0; i < theta.constants_count(); ++i)
        if (theta.constants()[static_cast<std::size_t>(i)].index == moments[k])
          slope[i] = sign * theta.slope(fit.u, i);
    }
    if (margin >= 0) continue;
    const double std = std::sqrt(slope.dot(fit.covariance * slope)), by = -margin / std;
    if (!(std > 0)) continue;  // as stated, and nobody asked the flight
    const std::size_t a = (c + 1) % 3, b = (c + 2) % 3;
    const double sum = p[static_cast<std::size_t>(moments[a])] + p[static_cast<std::size_t>(moments[b])];
    result.warn(
        "triangle_inequality",
        fmt::format("{} = {} exceeds {} + {} = {} kg m^2, which no body does, by {} standard "
                    "deviations: {}",
                    names[c], format_number(p[static_cast<std::size_t>(moments[c])]), names[a], names[b],
                    format_number(sum), format_number(by, 2),
                    by < kByChanceInertia ? "by chance, if the vehicle is nearly flat"
                                          : "another constant is wrong (arm, kQ, mass), or an effect is "
                                            "missing"));
  }
}

Eigen::VectorXd nearest_body(const Theta& theta, const FlightFit& fit) {
  Eigen::VectorXd u = fit.u;
  if (least_moment(theta, Eigen::VectorXd::Zero(theta.size())).share < 0) return u;
  for (int round = 0; round < kMostRounds; ++round) {
    const Least least = least_moment(theta, u);
    if (least.share > -kFlat) break;
    // The point of the linearised border that is nearest to the fit.
    const Eigen::VectorXd across = fit.naive_covariance * least.slope;
    const double variance = least.slope.dot(across);
    if (!(variance > 0)) break;  // as stated, and nobody asked the flight
    u = fit.u - across * ((least.share + least.slope.dot(fit.u - u)) / variance);
  }
  return u;
}

}  // namespace ident
