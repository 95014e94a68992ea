// Collects products of rows at lags, and combines them for a colour.
#include "ident/lsq/least_squares_lag_products.h"

#include <algorithm>
#include <cmath>

namespace ident {

LagProducts::LagProducts(Eigen::Index columns, Eigen::Index longest_order) : order_(longest_order) {
  for (Eigen::Index a = 0; a <= order_; ++a)
    G_.emplace_back(static_cast<std::size_t>(a + 1), Eigen::MatrixXd::Zero(columns, columns));
}

void LagProducts::add(const Eigen::MatrixXd& rows, const std::vector<bool>& missing) {
  const Eigen::Index n = rows.rows();
  // Blocks of consecutive rows that are regular.
  const auto add_block = [&](Eigen::Index begin, Eigen::Index end) {
    if (end <= begin) return;
    for (Eigen::Index a = 0; a <= order_; ++a)
      for (Eigen::Index b = 0; b <= a; ++b)
        G_[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)].noalias() +=
            rows.middleRows(begin - a, end - begin).transpose() * rows.middleRows(begin - b, end - begin);
  };
  Memory memory(order_);
  Eigen::Index begin = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool absent = missing[static_cast<std::size_t>(i)];
    if (absent || !memory.is_full(i)) {
      add_block(begin, i);
      begin = i + 1;
    }
    if (absent) continue;
    count_ += 1.0;
    if (!memory.is_full(i)) {
      IrregularRow row{.z = rows.row(i), .distance = memory.distances(i)};
      row.before.resize(static_cast<Eigen::Index>(row.distance.size()), rows.cols());
      for (std::size_t a = 0; a < row.distance.size(); ++a)
        row.before.row(static_cast<Eigen::Index>(a)) = rows.row(i - row.distance[a]);
      irregular_.push_back(std::move(row));
    }
    memory.remember(i);
  }
  add_block(begin, n);
}

DecorrelatedSums LagProducts::sums(const Colour& colour) const {
  const Eigen::Index p = colour.order();
  const auto a_of = [&](Eigen::Index k) { return k == 0 ? 1.0 : -colour.phi()(k - 1); };
  Eigen::MatrixXd all = G_[0][0];
  for (Eigen::Index a = 1; a <= p; ++a)
    for (Eigen::Index b = 0; b <= a; ++b) {
      const Eigen::MatrixXd& G = G_[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
      const double weight = a_of(a) * a_of(b);
      all += weight * G;
      if (a != b) all += weight * G.transpose();
    }
  DecorrelatedSums result;
  for (const IrregularRow& row : irregular_) {
    // As far back as a colour of this order looks.
    const auto reach = std::min(row.distance.size(), static_cast<std::size_t>(2 * p));
    const std::vector<Eigen::Index> distance(row.distance.begin(),
                                             row.distance.begin() + static_cast<std::ptrdiff_t>(reach));
    const Colour::Prediction best = colour.predict(distance);
    const Eigen::RowVectorXd error =
        row.z - best.weight.transpose() * row.before.topRows(static_cast<Eigen::Index>(reach));
    all.noalias() += error.transpose() * error / best.variance;
    result.log_variances += std::log(best.variance);
  }
  const Eigen::Index k = all.cols() - 1;
  result.JJ = all.topLeftCorner(k, k);
  result.Jr = all.col(k).head(k);
  result.rr = all(k, k);
  return result;
}

}  // namespace ident
