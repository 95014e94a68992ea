// Smoothed power of residuals, and the generic rival of all causes.
#include "rival_generic.h"

#include <algorithm>
#include <cmath>

namespace rival {

namespace {

constexpr Eigen::Index kSmooth = 16;  // rows, about 0.2 s
constexpr Eigen::Index kFeatures = 30;

struct Power {
  double smooth, noise;  // of the moving mean; of that the part that white noise explains
};

Power power(const std::vector<Series>& residuals, std::size_t s) {
  double sum = 0, count = 0, rough = 0;
  for (const Series& log : residuals) {
    const VectorXd& x = log[s];
    const Eigen::Index width = s >= 6 && s < 12 ? 2 : kSmooth;
    for (Eigen::Index i = 0; i + width <= x.size(); ++i) sum += std::pow(x.segment(i, width).mean(), 2);
    for (Eigen::Index i = 0; i + 2 < x.size(); ++i) rough += std::pow(x[i] - 2 * x[i + 1] + x[i + 2], 2) / 6;
    count += static_cast<double>(x.size());
  }
  if (count == 0) return {0, 1};
  const bool differenced =
      s >= 3 && s < 6;  // its noise is not white: almost nothing of it is left after smoothing
  const double width = s >= 6 && s < 12 ? 2 : static_cast<double>(kSmooth);
  return {sum / count, rough / count / (differenced ? width * width : width)};
}

// Inputs at a block; rates and speeds are means over 0.3 s, so that their noise is not that of the residual.
VectorXd features(const Log& log, std::size_t k) {
  const Block& b = log.blocks[k];
  const std::size_t half = static_cast<std::size_t>(0.15 / log.step());
  const std::size_t from = k < half ? 0 : k - half, to = std::min(k + half, log.blocks.size() - 1);
  Vector3d w = Vector3d::Zero();
  Four command = Four::Zero();
  for (std::size_t i = from; i <= to; ++i) {
    w += log.blocks[i].gyro / static_cast<double>(to - from + 1);
    command += log.delta[std::min(i * log.rows_per_block, log.delta.size() - 1)] /
               static_cast<double>(to - from + 1);
  }
  const Vector3d v = b.q.conjugate() * b.v;
  VectorXd x(kFeatures);
  x << 1, v, v * v.norm(), v.cwiseProduct(v), w, w.cwiseProduct(v), w.x() * w.y(), w.y() * w.z(),
      w.z() * w.x(), command, command.cwiseProduct(command), 1 / std::max(0.05, -b.p.z()), b.voltage, b.t;
  return x;
}

}  // namespace

double material_share(const std::vector<Series>& before, const std::vector<Series>& after) {
  double most = 0;
  for (std::size_t s = 0; s < kSeries; ++s) {
    const Power a = power(before, s), b = power(after, s);
    if (a.smooth > 0) most = std::max(most, (a.smooth - b.smooth) / a.smooth);
  }
  return most;
}

double closed_share(const std::vector<Series>& before, const std::vector<Series>& after) {
  double gap = 0, left = 0;
  for (std::size_t s = 0; s < kSeries; ++s) {
    const Power a = power(before, s), b = power(after, s);
    if (a.noise <= 0) continue;
    gap += std::max(0.0, a.smooth / a.noise - 1);
    left += std::max(0.0, b.smooth / a.noise - 1);
  }
  return gap > 0 ? 1 - left / gap : 0;
}

double generic_gain(const std::vector<Log>& logs, const std::vector<Series>& residuals) {
  const Whitening whitening(residuals);
  double gain = 0;
  for (std::size_t s = 0; s < 6; ++s) {  // forces and moments
    MatrixXd G = MatrixXd::Zero(kFeatures, kFeatures);
    std::vector<MatrixXd> left(logs.size());
    VectorXd b = VectorXd::Zero(kFeatures);
    std::vector<VectorXd> target(logs.size());
    for (std::size_t l = 0; l < logs.size(); ++l) {
      left[l].resize(residuals[l][s].size(), kFeatures);
      for (Eigen::Index k = 0; k < left[l].rows(); ++k) {
        left[l].row(k) = features(logs[l], static_cast<std::size_t>(k)).transpose();
      }
      left[l] = whitening.filtered(s, left[l]);
      target[l] = whitening.filtered(s, residuals[l][s]);
      for (Eigen::Index k = 0; k < left[l].rows(); ++k) {
        if (is_held_out(logs[l].blocks[static_cast<std::size_t>(k)].t)) continue;
        G += left[l].row(k).transpose() * left[l].row(k);
        b += left[l].row(k).transpose() * target[l][k];
      }
    }
    const VectorXd scale = G.diagonal().cwiseMax(1e-24).cwiseSqrt().cwiseInverse();
    MatrixXd S = scale.asDiagonal() * G * scale.asDiagonal();
    S.diagonal().array() += 1e-6;
    const VectorXd w = scale.cwiseProduct(S.ldlt().solve(scale.cwiseProduct(b)));
    double won = 0;
    for (std::size_t l = 0; l < logs.size(); ++l) {
      const VectorXd after = target[l] - left[l] * w;
      for (Eigen::Index k = 0; k < after.size(); ++k) {
        if (!is_held_out(logs[l].blocks[static_cast<std::size_t>(k)].t)) continue;
        won += 0.5 * (std::pow(target[l][k], 2) - std::pow(after[k], 2));
      }
    }
    gain += std::max(0.0, won);
  }
  return gain;
}

}  // namespace rival
