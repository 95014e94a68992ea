// Curvature of the restricted likelihood, and importance sampling from it.
#include "ident/lsq/least_squares_sensitivity.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_likelihood.h"

namespace ident {
namespace {

constexpr int kDraws = 150, kFewDraws = 40;
constexpr double kManyRows = 20000;  // from there on the constants are known so well that few draws do
// Draws spread wider than the curvature of the likelihood says: its tails are long.
constexpr double kWider = 1.3;

/// Level and colour of all groups around a solution, moved along one list of constants: for every group with
/// a free level its log variance, then atanh of its partial autocorrelations.
class NoiseConstants {
 public:
  NoiseConstants(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                 const std::vector<GroupNoise>& noise)
      : at_(noise), likelihood_(problem, rows, noise, 0) {
    for (std::size_t g = 0; g < noise.size(); ++g)
      if (likelihood_.level_is_free(g)) {
        first_.push_back({g, size_});
        size_ += 1 + noise[g].colour.order();
      }
  }

  Eigen::Index size() const { return size_; }
  const RestrictedLikelihood& likelihood() const { return likelihood_; }
  struct Block {
    std::size_t group;
    Eigen::Index first;
  };
  const std::vector<Block>& blocks() const { return first_; }
  Eigen::Index size_of(const Block& block) const { return 1 + at_[block.group].colour.order(); }

  /// Sets all constants to those found plus a change; returns the log likelihood there. Intervals are flat in
  /// atanh(partial): what lasts long is what makes an estimate wrong, and few rows hardly speak against it.
  double set(const Eigen::VectorXd& change) {
    for (const Block& block : first_) {
      Eigen::VectorXd partial = at_[block.group].colour.partial();
      const double largest = largest_atanh(likelihood_.rows(block.group));
      for (Eigen::Index k = 0; k < partial.size(); ++k)
        partial(k) =
            std::tanh(std::clamp(std::atanh(partial(k)) + change(block.first + k + 1), -largest, largest));
      if (partial.size() > 0 && change.segment(block.first + 1, partial.size()) != last_of(block))
        likelihood_.set_colour(block.group, Colour(partial));
      likelihood_.set_level(block.group, at_[block.group].sigma * std::exp(0.5 * change(block.first)));
    }
    last_ = change;
    return -0.5 * likelihood_.minus_two_log();
  }

 private:
  Eigen::VectorXd last_of(const Block& block) const {
    const Eigen::Index n = size_of(block) - 1;
    return last_.size() == size_ ? Eigen::VectorXd(last_.segment(block.first + 1, n))
                                 : Eigen::VectorXd::Zero(n);
  }

  const std::vector<GroupNoise> at_;
  RestrictedLikelihood likelihood_;
  std::vector<Block> first_;
  Eigen::Index size_ = 0;
  Eigen::VectorXd last_;
};

double step_of(const NoiseConstants& constants, const NoiseConstants::Block& block) {
  return std::clamp(0.3 / std::sqrt(constants.likelihood().rows(block.group)), 1e-3, 0.1);
}

/// Inverse of the curvature of the likelihood along the constants of one group. A constant on the edge of its
/// range has no maximum there: it counts as known to about 1.
Eigen::MatrixXd block_covariance(NoiseConstants& constants, const NoiseConstants::Block& block) {
  const Eigen::Index n = constants.size_of(block);
  const double h = step_of(constants, block);
  const auto unit = [&](Eigen::Index k) {
    return Eigen::VectorXd(h * Eigen::VectorXd::Unit(constants.size(), block.first + k));
  };
  const auto l = [&](const Eigen::VectorXd& change) { return constants.set(change); };
  Eigen::MatrixXd H(n, n);
  const double l0 = l(Eigen::VectorXd::Zero(constants.size()));
  for (Eigen::Index a = 0; a < n; ++a) {
    H(a, a) = -(l(unit(a)) + l(-unit(a)) - 2.0 * l0) / (h * h);
    for (Eigen::Index b = 0; b < a; ++b)
      H(a, b) = H(b, a) =
          -(l(unit(a) + unit(b)) - l(unit(a) - unit(b)) - l(unit(b) - unit(a)) + l(-unit(a) - unit(b))) /
          (4.0 * h * h);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(H);
  const Eigen::VectorXd inverse = eigen.eigenvalues().cwiseMax(0.25).cwiseInverse();
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

Eigen::MatrixXd constants_covariance(NoiseConstants& constants) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(constants.size(), constants.size());
  for (const NoiseConstants::Block& block : constants.blocks()) {
    const Eigen::Index n = constants.size_of(block);
    C.block(block.first, block.first, n, n) = block_covariance(constants, block);
  }
  return C;
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& M) {
  return M.llt().solve(Eigen::MatrixXd::Identity(M.rows(), M.cols()));
}

/// Van der Corput's sequence: even coverage of (0, 1), the same in every run.
double radical_inverse(int i, int base) {
  double value = 0.0;
  for (double digit = 1.0 / base; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

/// Point number i of a normal distribution in n dimensions (Halton's sequence), the log of its density with
/// it.
struct Point {
  Eigen::VectorXd u;
  double log_density;
};
Point point(int i, Eigen::Index n) {
  constexpr std::array primes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71};
  Point p{.u = Eigen::VectorXd::Zero(n)};
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(n, primes.size()); ++k)
    p.u(k) = normal_quantile(radical_inverse(i + 20, primes[static_cast<std::size_t>(k)]));
  p.log_density = -0.5 * p.u.squaredNorm();
  p.u *= kWider;
  return p;
}

}  // namespace

NoiseSensitivity noise_sensitivity(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                                   const std::vector<GroupNoise>& noise) {
  NoiseConstants constants(problem, rows, noise);
  NoiseSensitivity result{.constants_covariance = constants_covariance(constants)};
  for (const NoiseConstants::Block& block : constants.blocks())
    for (Eigen::Index k = 0; k < constants.size_of(block); ++k) {
      const double h = step_of(constants, block);
      const Eigen::VectorXd change = h * Eigen::VectorXd::Unit(constants.size(), block.first + k);
      constants.set(change);
      const Eigen::MatrixXd above = inverse(constants.likelihood().information());
      constants.set(-change);
      result.slopes.push_back((above - inverse(constants.likelihood().information())) / (2.0 * h));
    }
  return result;
}

std::vector<NoiseDraw> noise_draws(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                                   const std::vector<GroupNoise>& noise) {
  if (std::ranges::none_of(noise, [](const GroupNoise& g) { return g.colour.order() > 0; })) return {};
  NoiseConstants constants(problem, rows, noise);
  const Eigen::MatrixXd spread = constants_covariance(constants).llt().matrixL();
  const double l0 = constants.set(Eigen::VectorXd::Zero(constants.size()));
  const int count = static_cast<double>(rows.r.size()) > kManyRows ? kFewDraws : kDraws;
  std::vector<NoiseDraw> draws;
  double total = 0.0;
  for (int i = 1; i <= count; ++i) {
    const Point p = point(i, constants.size());
    const double log_weight = constants.set(spread * p.u) - l0 - p.log_density;
    if (!std::isfinite(log_weight)) continue;
    const Eigen::LLT<Eigen::MatrixXd> M(constants.likelihood().information());
    const Eigen::Index n = rows.J.cols();
    draws.push_back({.weight = std::exp(std::min(log_weight, 500.0)),
                     .shift = -M.solve(constants.likelihood().gradient()),
                     .covariance = M.solve(Eigen::MatrixXd::Identity(n, n))});
    total += draws.back().weight;
  }
  for (NoiseDraw& draw : draws) draw.weight /= total;
  return draws;
}

}  // namespace ident
