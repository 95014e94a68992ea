// The attitude against integrated rates over short and long lags: white noise of the attitude is the same in
// both, that of the rates grows by its own density, and what grows faster is drift.
#include "ident/estimators/flight_attitude_drift.h"

#include <Eigen/QR>
#include <cmath>

#include "ident/estimators/flight_record_start.h"

namespace ident {
namespace {

using Eigen::Array3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

// Lags, s, and the windows over which attitude is averaged at both ends.
constexpr double kShort = 0.25, kLong = 1.0, kMean = 0.2;
constexpr int kRegressors = 7;  // angles, rates, and a bias
// What is beyond chance, in deviations, and beyond what rates are known to do: their noise is not quite
// white.
constexpr double kBeyondChance = 2.5, kBeyondRates = 1.3;
constexpr double kTime = 3.0;         // s, to start from
constexpr double kLeastShare = 0.05;  // of what all axes show, to start from

// What the attitude of one arc strays from the integral of the rates, at its samples.
struct Stray {
  std::vector<double> t;
  std::vector<Vector3d> stray, angle, rate;  // sums over all samples before, for means of windows
};

Stray stray_of(const FlightArc& arc) {
  Stray out;
  std::array<std::vector<double>, 3> w;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> column(arc.rows());
    for (std::size_t i = 0; i < arc.rows(); ++i) column[i] = arc.y[i * kChannels + kGyro + k];
    if (w[k] = interpolated(arc.t, column); w[k].empty()) return out;
  }
  out.stray = out.angle = out.rate = {Vector3d::Zero()};
  const auto rate_at = [&](std::size_t i) { return Vector3d(w[0][i], w[1][i], w[2][i]); };
  Vec4<double> before;
  const Vec4<double> still(1, 0, 0, 0);
  Vec4<double> turned = still;  // since the last sample, by the rates
  Vector3d stray = Vector3d::Zero(), angle = stray;
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    if (i > 0) {
      const Vector3d step = 0.5 * (arc.t[i] - arc.t[i - 1]) * (rate_at(i) + rate_at(i - 1));
      turned = quaternion_product(turned, quaternion_from_rotation_vector(step)), angle += step;
    }
    if (!std::isfinite(arc.y[i * kChannels + kAttitude])) continue;
    const Vec4<double> q(arc.q[4 * i], arc.q[4 * i + 1], arc.q[4 * i + 2], arc.q[4 * i + 3]);
    if (!out.t.empty())
      stray += rotation_vector_from_quaternion(quaternion_product(conjugate(before), q)) -
               rotation_vector_from_quaternion(turned);
    before = q, turned = still;
    out.t.push_back(arc.t[i]);
    out.stray.push_back(out.stray.back() + stray), out.angle.push_back(out.angle.back() + angle);
    out.rate.push_back(out.rate.back() + rate_at(i));
  }
  return out;
}

// Mean square, about each axis, of what it strays over a lag beyond what goes with angles and rates.
struct MeanSquare {
  Array3d sum = Array3d::Zero();
  double degrees = 0;

  void add(const Stray& of, double lag) {
    std::vector<std::array<std::size_t, 4>> windows;  // samples: begin and end of the first and the last
    const auto at = [&](double t) {
      return static_cast<std::size_t>(std::lower_bound(of.t.begin(), of.t.end(), t) - of.t.begin());
    };
    for (double t = of.t.front(); t + lag + kMean < of.t.back(); t += lag) {
      const std::array one = {at(t), at(t + kMean), at(t + lag), at(t + lag + kMean)};
      if (one[1] > one[0] && one[3] > one[2]) windows.push_back(one);
    }
    const auto n = static_cast<Eigen::Index>(windows.size());
    if (n < 2 * kRegressors) return;
    MatrixXd X(n, kRegressors), Y(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& [a, b, c, d] = windows[static_cast<std::size_t>(i)];
      const auto grown = [&, a = a, b = b, c = c, d = d](const std::vector<Vector3d>& sums) {
        return Vector3d((sums[d] - sums[c]) / static_cast<double>(d - c) -
                        (sums[b] - sums[a]) / static_cast<double>(b - a));
      };
      X.row(i) << grown(of.angle).transpose(), grown(of.rate).transpose(), 1.0;
      Y.row(i) = grown(of.stray).transpose();
    }
    const MatrixXd left = Y - X * X.colPivHouseholderQr().solve(Y);
    sum += left.colwise().squaredNorm().transpose().array(), degrees += static_cast<double>(n - kRegressors);
  }
  Array3d mean() const { return sum / degrees; }
  Array3d variance() const { return 2 * mean().square() / degrees; }
};

// Density of the white noise of the rates, rad^2/s.
Array3d density_of_rates(const FlightRecord& record) {
  double samples = 0;
  for (const FlightArc& arc : record.arcs)
    for (std::size_t i = 0; i < arc.rows(); ++i) samples += std::isfinite(arc.y[i * kChannels + kGyro]);
  const Array3d sigma(record.sigma[kGyro], record.sigma[kGyro + 1], record.sigma[kGyro + 2]);
  return sigma.square() * record.duration / samples;
}

}  // namespace

std::array<ColouredNoise, 3> attitude_drift(const FlightRecord& record) {
  std::array<ColouredNoise, 3> none{};
  if (!record.signals.rates || !record.signals.attitude) return none;
  MeanSquare near, far;
  for (const FlightArc& arc : record.arcs)
    if (const Stray one = stray_of(arc); one.t.size() > 1) near.add(one, kShort), far.add(one, kLong);
  if (!(far.degrees > 0)) return none;
  const Array3d grown = (far.mean() - near.mean()) / (kLong - kShort), of_rates = density_of_rates(record);
  const double chance = std::sqrt((far.variance() + near.variance()).sum()) / (kLong - kShort);
  const double beyond = (grown - of_rates).sum();
  if (!(beyond > kBeyondChance * chance) || !(grown.sum() > kBeyondRates * of_rates.sum())) return none;
  std::array<ColouredNoise, 3> drift;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double density = std::max(grown[axis] - of_rates[axis], kLeastShare * beyond);
    drift[k] = {std::sqrt(density * kTime / 2), kTime};
  }
  return drift;
}

}  // namespace ident
