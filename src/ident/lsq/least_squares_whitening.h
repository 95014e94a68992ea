// Autoregressive noise: decorrelates rows of residuals and Jacobian, with rows missing where there were
// outliers.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

namespace ident {

/// Stationary autoregressive noise of order p with innovations of variance 1,
///
///     r_i = phi_1 r_(i-1) + ... + phi_p r_(i-p) + e_i
///
/// given by its partial autocorrelations, each in (-1, 1): every such set is stationary.
class Colour {
 public:
  explicit Colour(Eigen::VectorXd partial = Eigen::VectorXd());

  Eigen::Index order() const { return phi_.size(); }
  const Eigen::VectorXd& partial() const { return partial_; }
  const Eigen::VectorXd& phi() const { return phi_; }
  double variance() const { return covariance_(0); }
  double rho() const { return order() > 0 ? covariance_(1) / covariance_(0) : 0.0; }
  /// Covariance of two values `lag` steps apart.
  double covariance(Eigen::Index lag) const;

  /// Replaces rows [begin, end) of one series by their prediction errors from the rows before them, divided
  /// by the error's standard deviation. A missing row predicts nothing, and its own error is kept.
  /// Returns sum log(variance) over the rows that are there.
  double whiten(Eigen::Index begin, Eigen::Index end, const std::vector<bool>& missing,
                Eigen::MatrixXd& rows) const;

  /// The best prediction of a row from rows that lie `distance` steps before it, and its variance.
  struct Prediction {
    Eigen::VectorXd weight;
    double variance;
  };
  Prediction predict(const std::vector<Eigen::Index>& distance) const;

 private:
  /// At lags 0 to `longest`.
  std::vector<double> covariances(Eigen::Index longest) const;

  Eigen::VectorXd partial_, phi_, covariance_;  ///< the last at lags 0 to the order
};

/// Walks the rows of a series: which rows before a row are there to predict it from.
class Memory {
 public:
  explicit Memory(Eigen::Index order) : order_(order) {}

  /// Distances of the last rows that are there, newest first, at most twice the order.
  std::vector<Eigen::Index> distances(Eigen::Index row) const;
  /// Are all of the `order` rows before this one there?
  bool is_full(Eigen::Index row) const;
  void remember(Eigen::Index row);

 private:
  Eigen::Index order_;
  std::deque<Eigen::Index> seen_;
};

}  // namespace ident
