// Prediction errors of autoregressive noise, exact at the start of a series and across missing rows.
#include "ident/lsq/least_squares_whitening.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

constexpr Eigen::Index kLongestMemory = 400;  // rows further apart count as independent

/// Levinson-Durbin: partial autocorrelations to coefficients.
Eigen::VectorXd coefficients(const Eigen::VectorXd& partial) {
  Eigen::VectorXd phi(partial.size());
  for (Eigen::Index k = 0; k < partial.size(); ++k) {
    const Eigen::VectorXd before = phi.head(k);
    phi.head(k) = before - partial(k) * before.reverse();
    phi(k) = partial(k);
  }
  return phi;
}

/// Autocovariance at lags 0 to p by the Yule-Walker equations, innovations of variance 1.
Eigen::VectorXd yule_walker(const Eigen::VectorXd& phi) {
  const Eigen::Index p = phi.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(p + 1, p + 1);
  for (Eigen::Index lag = 0; lag <= p; ++lag)
    for (Eigen::Index k = 1; k <= p; ++k) A(lag, std::abs(lag - k)) -= phi(k - 1);
  return A.partialPivLu().solve(Eigen::VectorXd::Unit(p + 1, 0));
}

}  // namespace

Colour::Colour(Eigen::VectorXd partial)
    : partial_(std::move(partial)), phi_(coefficients(partial_)), covariance_(yule_walker(phi_)) {}

std::vector<double> Colour::covariances(Eigen::Index longest) const {
  std::vector<double> values(covariance_.begin(), covariance_.end());
  while (static_cast<Eigen::Index>(values.size()) <= longest) {
    double next = 0.0;
    if (static_cast<Eigen::Index>(values.size()) <= kLongestMemory)
      for (Eigen::Index k = 0; k < order(); ++k)
        next += phi_(k) * values[values.size() - 1 - static_cast<std::size_t>(k)];
    values.push_back(next);
  }
  return values;
}

double Colour::covariance(Eigen::Index lag) const { return covariances(lag)[static_cast<std::size_t>(lag)]; }

double Colour::whiten(Eigen::Index begin, Eigen::Index end, const std::vector<bool>& missing,
                      Eigen::MatrixXd& rows) const {
  if (order() == 0) return 0.0;
  const Eigen::Index p = order(), n = end - begin;
  const Eigen::MatrixXd raw = rows.middleRows(begin, n);
  for (Eigen::Index k = 1; k <= std::min(p, n - 1); ++k)
    rows.middleRows(begin + k, n - k) -= phi_(k - 1) * raw.topRows(n - k);

  // The start of a series and the rows behind a gap need the best prediction from what is there.
  Memory memory(p);
  double log_variances = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool absent = missing[static_cast<std::size_t>(begin + i)];
    if (!memory.is_full(i)) {
      const std::vector<Eigen::Index> distance = memory.distances(i);
      const Prediction best = predict(distance);
      Eigen::RowVectorXd error = raw.row(i);
      for (std::size_t a = 0; a < distance.size(); ++a)
        error -= best.weight(static_cast<Eigen::Index>(a)) * raw.row(i - distance[a]);
      rows.row(begin + i) = error / std::sqrt(best.variance);
      if (!absent) log_variances += std::log(best.variance);
    }
    if (!absent) memory.remember(i);
  }
  return log_variances;
}

Colour::Prediction Colour::predict(const std::vector<Eigen::Index>& distance) const {
  const auto known = static_cast<Eigen::Index>(distance.size());
  Eigen::Index longest = 0;
  for (const Eigen::Index d : distance) longest = std::max(longest, d);
  const std::vector<double> covariance_at = covariances(longest);
  const auto between = [&](Eigen::Index lag) { return covariance_at[static_cast<std::size_t>(lag)]; };
  Eigen::MatrixXd K(known, known);
  Eigen::VectorXd c(known);
  for (Eigen::Index a = 0; a < known; ++a) {
    const Eigen::Index d = distance[static_cast<std::size_t>(a)];
    c(a) = between(d);
    for (Eigen::Index b = 0; b < known; ++b)
      K(a, b) = between(std::abs(d - distance[static_cast<std::size_t>(b)]));
  }
  const Eigen::VectorXd weight = K.llt().solve(c);
  return {weight, variance() - c.dot(weight)};
}

std::vector<Eigen::Index> Memory::distances(Eigen::Index row) const {
  std::vector<Eigen::Index> result;
  for (const Eigen::Index seen : seen_) result.push_back(row - seen);
  return result;
}

bool Memory::is_full(Eigen::Index row) const {
  return order_ == 0 || (static_cast<Eigen::Index>(seen_.size()) >= order_ &&
                         seen_[static_cast<std::size_t>(order_ - 1)] == row - order_);
}

void Memory::remember(Eigen::Index row) {
  seen_.push_front(row);
  if (static_cast<Eigen::Index>(seen_.size()) > 2 * order_) seen_.pop_back();
}

}  // namespace ident
