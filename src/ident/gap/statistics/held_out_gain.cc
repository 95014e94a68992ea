// Folds of the flight, left out in turn.
#include "ident/gap/statistics/held_out_gain.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFolds = 6;
// A coefficient of a sensor is expected to be this much smaller than one of an acceleration.
constexpr double kSensorSize = 0.3;

// What is gained on parts of the flight that were left out, over the spread of what is missed there in units
// of white noise: coloured residuals promise more than they hold.
class HeldOutGain {
 public:
  /// A part: fall of the cost there, what the prediction misses along itself, and the variance that white
  /// noise gives that.
  void add(double fall, double missed, double variance) {
    gain_ += fall;
    if (variance > 0) spread_ += missed * missed / variance, parts_ += 1;
  }
  double honest() const { return gain_ / (parts_ > 0 ? std::max(spread_ / parts_, 1.0) : 1.0); }

 private:
  double gain_ = 0, spread_ = 0, parts_ = 0;
};

}  // namespace

double held_out_gain(const std::vector<ScoreBlock>& blocks, const PriorTerms& prior, double expected) {
  const Index m = blocks[0].score.size(), own = prior.slope.size();
  MatrixXd info = MatrixXd::Identity(m, m) / (expected * expected);
  info.topLeftCorner(own, own) = prior.information(1e-2);
  VectorXd pull = VectorXd::Zero(m);
  pull.head(own) = prior.gradient();
  const auto solved = [&](const MatrixXd& F, const VectorXd& g, Index size) {
    const MatrixXd H = F.topLeftCorner(size, size) + info.topLeftCorner(size, size);
    return VectorXd(-Eigen::LDLT<MatrixXd>(H).solve(g.head(size) + pull.head(size)));
  };
  const auto fall = [](const ScoreBlock& block, const VectorXd& x) {
    const Index n = x.size();
    return -2 * block.score.head(n).dot(x) - x.dot(block.information.topLeftCorner(n, n) * x);
  };
  HeldOutGain gain;
  for (int fold = 0; fold < kFolds; ++fold) {
    const auto left_out = [&](std::size_t b) { return static_cast<int>(b / 2) % kFolds == fold; };
    MatrixXd F = MatrixXd::Zero(m, m);
    VectorXd g = VectorXd::Zero(m);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      if (!left_out(b)) F += blocks[b].information, g += blocks[b].score;
    const VectorXd all = solved(F, g, m), plain = solved(F, g, own);
    VectorXd further = all;  // what the features say beyond theta
    further.head(own) -= plain;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (!left_out(b)) continue;
      const VectorXd known = blocks[b].information * further;
      const double missed = further.dot(blocks[b].score + blocks[b].information * all);
      gain.add(fall(blocks[b], all) - fall(blocks[b], plain), missed, further.dot(known));
    }
  }
  return gain.honest();
}

namespace {

double held_out_gain(const SensorResiduals& r, const MatrixXd& X, const std::vector<int>& parts,
                     double expected) {
  HeldOutGain gain;
  for (int fold = 0; fold < kFolds; ++fold) {
    VectorXd fitted_count = r.count, left_count = r.count;
    VectorXd fitted_sum = r.sum;
    for (Index k = 0; k < X.rows(); ++k) {
      const bool left_out = parts[static_cast<std::size_t>(k)] % kFolds == fold;
      (left_out ? fitted_count : left_count)[k] = 0;
      if (left_out) fitted_sum[k] = 0;
    }
    MatrixXd H = X.transpose() * fitted_count.asDiagonal() * X;
    H.diagonal().array() += 1 / (expected * expected);
    const VectorXd predicted = X * Eigen::LDLT<MatrixXd>(H).solve(X.transpose() * fitted_sum);
    double fall = 0, missed = 0, variance = 0;
    for (Index k = 0; k < X.rows(); ++k) {
      const double count = left_count[k], x = predicted[k];
      fall += count > 0 ? x * (2 * r.sum[k] - count * x) : 0.0;
      missed += count > 0 ? x * (r.sum[k] - count * x) : 0.0;
      variance += count * x * x;
      const auto part = [&](Index i) { return parts[static_cast<std::size_t>(i)]; };
      if (k + 1 < X.rows() && part(k + 1) == part(k)) continue;
      gain.add(fall, missed, variance);
      fall = missed = variance = 0;
    }
  }
  return gain.honest();
}

}  // namespace

double held_out_gain(const SensorResiduals& residuals, const MatrixXd& X, const std::vector<int>& parts) {
  double best = -1e300;
  for (const double size : kRegressionSizes)
    best = std::max(best, held_out_gain(residuals, X, parts, kSensorSize * size));
  return best;
}

void standardise(MatrixXd& X) {
  for (Index c = 0; c < X.cols(); ++c) {
    X.col(c).array() -= X.col(c).mean();
    const double s = std::sqrt(X.col(c).squaredNorm() / static_cast<double>(X.rows()));
    X.col(c) *= s > 1e-9 ? 1.0 / s : 0.0;
  }
}

}  // namespace ident
