// A ridge regression in each window, and variances that fit what it finds.
#include "ident/flight/conditioning/tone_amplitudes.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "ident/core/parallel.h"

namespace ident {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr int kRounds = 20;
constexpr double kEnoughWindows = 0.5;  // nats by which a round has to be better than the one before
constexpr double kFirst = 0.1, kLeastAmplitude = 1e-9;  // variances to start from, and that stand for none

}  // namespace

ToneSizes::ToneSizes(const TurningRotors& turning, const ToneWindows& sensor, std::vector<int> orders,
                     double scale)
    : turning_(turning), orders_(std::move(orders)), scale_(scale), windows_(sensor.windows.size()) {
  in_parallel(windows_.size(), [&](std::size_t k) {
    const ToneWindow& w = sensor.windows[k];
    const MatrixXd H = tones_in(w);
    for (Index axis = 0; axis < 3; ++axis) windows_[k][static_cast<std::size_t>(axis)] = told_by(w, H, axis);
  });
  found_ = found_from(windows_);
}

double ToneSizes::log_likelihood_of(int rotor) const {
  std::vector<Index> columns;
  for (std::size_t order = 0; order < orders_.size(); ++order)
    for (const Index part : {0, 1})
      columns.push_back(2 * (static_cast<Index>(order) * turning_.count() + rotor) + part);
  ToldWindows windows(windows_.size());
  for (std::size_t k = 0; k < windows.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Told& all = windows_[k][axis];
      windows[k][axis] = {all.G(columns, columns), all.b(columns), all.square, all.samples};
    }
  return found_from(windows).log_likelihood;
}

MatrixXd ToneSizes::expected(const ToneWindow& window) const {
  const MatrixXd H = tones_in(window);
  MatrixXd out(window.y.rows(), 3);
  for (Index axis = 0; axis < 3; ++axis)
    out.col(axis) = H * posterior(told_by(window, H, axis), found_, axis).mean;
  return out;
}

double ToneSizes::passes_for_motion(const ToneWindow& window, double hz) const {
  const VectorXd sizes = turning_.sizes(window);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t o = 0; o < orders_.size(); ++o) {
    const VectorXd folded = turning_.folded(window, orders_[o], scale_);
    for (Index n = 0; n < folded.size(); ++n)
      if (folded[n] < hz)
        sum +=
            sizes[n] * sizes[n] * found_.variance.row(static_cast<Index>(o) * folded.size() + n).transpose();
  }
  return sum.cwiseQuotient(found_.noise).maxCoeff();
}

ToneSizes::Told ToneSizes::told_by(const ToneWindow& window, const MatrixXd& tones, Index axis) {
  return {tones.transpose() * window.weighted(tones, axis), tones.transpose() * window.told.col(axis),
          window.y.col(axis).dot(window.told.col(axis)), static_cast<double>(window.y.rows())};
}

// Cosine and sine of each tone: [sample][2 x (order, and in it rotor)].
MatrixXd ToneSizes::tones_in(const ToneWindow& window) const {
  const Eigen::ArrayXXcd turned = turning_.turned(window, scale_);
  const VectorXd sizes = turning_.sizes(window);
  MatrixXd out(turned.rows(), 2 * turned.cols() * static_cast<Index>(orders_.size()));
  Index column = 0;
  for (const int order : orders_)
    for (Index rotor = 0; rotor < turned.cols(); ++rotor) {
      Eigen::ArrayXcd tone = turned.col(rotor);
      for (int k = 1; k < order; ++k) tone *= turned.col(rotor);
      out.col(column++) = sizes[rotor] * tone.real();
      out.col(column++) = sizes[rotor] * tone.imag();
    }
  return out;
}

ToneSizes::Found ToneSizes::found_from(const ToldWindows& windows) const {
  Found found;
  if (windows.empty()) return found;
  // No tone is larger than all that is there: of rotors that turn alike only the sum is told. Where motion is
  // little is told of a tone and of what is there.
  Vector3d square = Vector3d::Zero();
  MatrixXd told = MatrixXd::Zero(windows[0][0].b.size() / 2, 3);  // of a tone of variance one
  for (const auto& window : windows)
    for (Index axis = 0; axis < 3; ++axis) {
      const Told& of = window[static_cast<std::size_t>(axis)];
      square[axis] += of.square;
      for (Index k = 0; k < told.rows(); ++k)
        told(k, axis) += of.G(2 * k, 2 * k) + of.G(2 * k + 1, 2 * k + 1);
    }
  const MatrixXd most =
      (2 * told.cwiseMax(kLeastAmplitude).cwiseInverse() * square.asDiagonal()).cwiseMax(kLeastAmplitude);
  found.variance = MatrixXd::Constant(told.rows(), 3, kFirst);
  for (int round = 0; round < kRounds; ++round) {
    const double before = found.log_likelihood;
    found = updated(windows, found, most);
    if (round > 1 && std::abs(found.log_likelihood - before) < kEnoughWindows) break;
  }
  return found;
}

ToneSizes::Posterior ToneSizes::posterior(const Told& told, const Found& by, Index axis) {
  VectorXd s(told.b.size());  // cosine and sine share a deviation
  for (Index k = 0; k < s.size(); ++k) s[k] = std::sqrt(by.variance(k / 2, axis));
  const Eigen::LLT<MatrixXd> A(MatrixXd::Identity(s.size(), s.size()) +
                               s.asDiagonal() * told.G * s.asDiagonal() / by.noise[axis]);
  const MatrixXd root = A.matrixL().solve(MatrixXd(s.asDiagonal()));
  return {root.transpose() * (root * told.b) / by.noise[axis], root.colwise().squaredNorm().transpose(),
          2 * A.matrixLLT().diagonal().array().log().sum()};
}

// The likelihood is that of the variances before.
ToneSizes::Found ToneSizes::updated(const ToldWindows& windows, const Found& from, const MatrixXd& most) {
  MatrixXd square = MatrixXd::Zero(from.variance.rows(), 3), known = square;
  Vector3d rest = Vector3d::Zero(), free = rest, likelihood = rest;
  in_parallel(3, [&](std::size_t a) {
    const auto axis = static_cast<Index>(a);
    for (const auto& window : windows) {
      const Told& told = window[a];
      const Posterior x = posterior(told, from, axis);
      free[axis] += told.samples;
      for (Index i = 0; i < x.mean.size(); ++i) {
        const double share = 1 - x.variance[i] / from.variance(i / 2, axis);
        square(i / 2, axis) += x.mean[i] * x.mean[i], known(i / 2, axis) += share, free[axis] -= share;
      }
      rest[axis] += told.square - 2 * x.mean.dot(told.b) + x.mean.dot(told.G * x.mean);
      likelihood[axis] -= 0.5 * (x.log_det + (told.square - x.mean.dot(told.b)) / from.noise[axis] -
                                 told.square + told.samples * std::log(from.noise[axis]));
    }
  });
  Found out{MatrixXd(square.rows(), 3), (rest.array() / free.array().max(1.0)).max(kLeastAmplitude),
            likelihood.sum()};
  for (Index axis = 0; axis < 3; ++axis)
    out.variance.col(axis) = (square.col(axis).array() / known.col(axis).array().max(kLeastAmplitude))
                                 .max(kLeastAmplitude)
                                 .min(most.col(axis).array());
  return out;
}

}  // namespace ident
