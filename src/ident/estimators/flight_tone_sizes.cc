// A ridge regression in each window, and variances that fit what it finds.
#include "ident/estimators/flight_tone_sizes.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "ident/core/parallel.h"

namespace ident {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr int kRounds = 15;
constexpr double kFirst = 0.1, kLeast = 1e-9;  // variances to start from, and that stand for none

}  // namespace

ToneSizes::ToneSizes(const TurningRotors& turning, const ToneWindows& sensor, std::vector<int> rotors,
                     std::vector<int> orders, double scale)
    : turning_(turning),
      rotors_(std::move(rotors)),
      orders_(std::move(orders)),
      scale_(scale),
      variance_(MatrixXd::Constant(static_cast<Index>(rotors_.size() * orders_.size()), 3, kFirst)) {
  std::vector<std::array<Told, 3>> windows(sensor.windows.size());
  in_parallel(windows.size(), [&](std::size_t k) {
    const ToneWindow& w = sensor.windows[k];
    const MatrixXd H = tones_in(w);
    for (Index axis = 0; axis < 3; ++axis) windows[k][static_cast<std::size_t>(axis)] = told_by(w, H, axis);
  });
  // No tone is larger than all that is there: of rotors that turn alike only the sum is told.
  Vector3d square = Vector3d::Zero(), left = square;
  for (const auto& window : windows)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      square[static_cast<Index>(axis)] += window[axis].square;
      left[static_cast<Index>(axis)] += window[axis].left;
    }
  for (int round = 0; round < kRounds; ++round) update(windows, 2 * square.cwiseQuotient(left));
}

MatrixXd ToneSizes::expected(const ToneWindow& window) const {
  const MatrixXd H = tones_in(window);
  MatrixXd out(window.y.rows(), 3);
  for (Index axis = 0; axis < 3; ++axis) out.col(axis) = H * posterior(told_by(window, H, axis), axis).mean;
  return out;
}

ToneSizes::Told ToneSizes::told_by(const ToneWindow& window, const MatrixXd& tones, Index axis) {
  const VectorXd y = window.weighted(window.y.col(axis), axis);
  return {tones.transpose() * window.weighted(tones, axis), tones.transpose() * y, window.y.col(axis).dot(y),
          static_cast<double>(y.size()) - window.taken.col(axis).sum()};
}

// Cosine and sine of each tone: [sample][2 x (order, and in it rotor)].
MatrixXd ToneSizes::tones_in(const ToneWindow& window) const {
  const Eigen::ArrayXXcd turned = turning_.turned(window, scale_);
  const VectorXd sizes = turning_.sizes(window);
  MatrixXd out(turned.rows(), 2 * variance_.rows());
  Index column = 0;
  for (const int order : orders_)
    for (const int rotor : rotors_) {
      const Eigen::ArrayXcd tone = turned.col(rotor).pow(order);
      out.col(column++) = sizes[rotor] * tone.real();
      out.col(column++) = sizes[rotor] * tone.imag();
    }
  return out;
}

ToneSizes::Posterior ToneSizes::posterior(const Told& told, Index axis) const {
  VectorXd s(2 * variance_.rows());
  for (Index k = 0; k < s.size(); ++k) s[k] = std::sqrt(variance_(k / 2, axis));
  const Eigen::LLT<MatrixXd> A(MatrixXd::Identity(s.size(), s.size()) +
                               s.asDiagonal() * told.G * s.asDiagonal() / noise_[axis]);
  const MatrixXd root = A.matrixL().solve(MatrixXd(s.asDiagonal()));
  return {root.transpose() * (root * told.b) / noise_[axis], root.colwise().squaredNorm().transpose(),
          2 * A.matrixLLT().diagonal().array().log().sum()};
}

void ToneSizes::update(const std::vector<std::array<Told, 3>>& windows, const Vector3d& most) {
  MatrixXd square = MatrixXd::Zero(variance_.rows(), 3), known = square;
  Vector3d rest = Vector3d::Zero(), free = rest, likelihood = rest;
  in_parallel(3, [&](std::size_t a) {
    const auto axis = static_cast<Index>(a);
    for (const auto& window : windows) {
      const Told& told = window[a];
      const Posterior x = posterior(told, axis);
      free[axis] += told.left;
      for (Index i = 0; i < x.mean.size(); ++i) {
        const double share = 1 - x.variance[i] / variance_(i / 2, axis);
        square(i / 2, axis) += x.mean[i] * x.mean[i], known(i / 2, axis) += share, free[axis] -= share;
      }
      rest[axis] += told.square - 2 * x.mean.dot(told.b) + x.mean.dot(told.G * x.mean);
      likelihood[axis] -= 0.5 * (x.log_det + (told.square - x.mean.dot(told.b)) / noise_[axis] - told.square +
                                 told.left * std::log(noise_[axis]));
    }
  });
  log_likelihood_ = likelihood.sum();
  for (Index axis = 0; axis < 3; ++axis)
    variance_.col(axis) =
        (square.col(axis).array() / known.col(axis).array().max(kLeast)).max(kLeast).min(most[axis]);
  noise_ = (rest.array() / free.array().max(1.0)).max(kLeast);
}

}  // namespace ident
