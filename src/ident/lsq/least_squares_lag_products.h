// Sums of products of rows at several lags: the restricted likelihood of any colour without going over the
// rows.
#pragma once

#include "ident/lsq/least_squares_whitening.h"

namespace ident {

/// Sums over decorrelated rows z = (J, r), not divided by their level.
struct DecorrelatedSums {
  Eigen::MatrixXd JJ;
  Eigen::VectorXd Jr;
  double rr = 0.0, log_variances = 0.0;
};

/// Collects the rows of one group. Where all rows of the longest memory are there, the sums follow from
///
///     sum (z_i - phi_1 z_(i-1) - ...)' (z_i - phi_1 z_(i-1) - ...)  =  sum_ab a_a a_b G_ab ,  a = (1, -phi)
///
/// with G_ab = sum z_(i-a)' z_(i-b); the few other rows are kept as they are.
class LagProducts {
 public:
  LagProducts(Eigen::Index columns, Eigen::Index longest_order);

  /// Adds one series of rows (J, r).
  void add(const Eigen::MatrixXd& rows, const std::vector<bool>& missing);

  double rows() const { return count_; }
  DecorrelatedSums sums(const Colour& colour) const;

 private:
  struct IrregularRow {
    Eigen::RowVectorXd z;
    std::vector<Eigen::Index> distance;
    Eigen::MatrixXd before;
  };

  Eigen::Index order_;
  double count_ = 0.0;
  std::vector<std::vector<Eigen::MatrixXd>> G_;  ///< [a][b], b <= a
  std::vector<IrregularRow> irregular_;
};

}  // namespace ident
