// Statistics of the last linearisation: moments of the residuals, marginal likelihood, slopes along a step,
// scores by block of time.
#include <algorithm>
#include <cmath>

#include "ident/core/simd/dense_rows.h"
#include "ident/flight/smoother/chunk_maps.h"
#include "ident/flight/smoother/smoother.h"

namespace ident {

using chunk::rows_in;
using chunk::rows_of;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Moments FlightSmoother::moments() const {
  Moments sum;
  for (const ChunkResult& r : results_)
    for (std::size_t c = 0; c < kChannels; ++c) {
      sum.square[c] += r.square[c];
      sum.leverage[c] += r.leverage[c];
      sum.count[c] += r.count[c];
    }
  return sum;
}

VectorXd FlightSmoother::information_of_held_states() const {
  VectorXd sum = VectorXd::Zero(theta_->size());
  for (const ChunkResult& r : results_) sum += chunk::A(r).diagonal().tail(sum.size());
  return sum;
}

double FlightSmoother::surprise() const {
  const PriorTerms prior = theta_->prior(trial_u_);
  double sum = reduced_.cost + prior.cost() + reduced_.log_det;
  if (theta_->size() > 0)  // down to the optimum, along the quadratic form
    sum += shared_optimum().dot(reduced_.g + prior.gradient());
  for (const ChunkResult& r : results_)
    for (std::size_t c = 0; c < kChannels; ++c) sum += 2 * r.count[c] * std::log(noise_.sigma[c]);
  return sum;
}

FlightSmoother::Along FlightSmoother::along(const VectorXd& du) {
  constexpr double kShare = 1e-3;  // of the step, to either side
  const std::size_t K = places_.size();
  const Index n = record_->layout.size, from = padded(record_->layout.size);
  const std::vector<chunk::RowMatrix> dX = state_slopes();
  std::vector<VectorXd> dx(K);
  for (std::size_t k = 0; k < K; ++k) dx[k] = dX[k].leftCols(du.size()) * du;
  Along out{{}, {}, std::vector<VectorXd>(K), std::vector<VectorXd>(K), std::vector<VectorXd>(K)};
  for (std::size_t k = 0; k < K; ++k) {
    if (!places_[k].linked) continue;
    const chunk::RowMatrix& E = linearised_.E[k];
    out.defects[k] = defect(k), out.weights[k] = link_weight(k);
    out.defect_slopes[k] = E.leftCols(n) * dx[k] + E.middleCols(from, shared()) * du - dx[k + 1];
  }
  const auto residuals_at = [&](double share) {
    for (std::size_t k = 0; k < K; ++k) trial_[k] = moved(states_[k], share * dx[k]);
    evaluate(u_ + share * du, false, false);
    std::vector<std::vector<double>> all;
    for (const ChunkResult& r : results_) all.push_back(r.residuals);
    return all;
  };
  const auto before = residuals_at(-kShare);
  out.residual_slopes = residuals_at(kShare);
  for (std::size_t k = 0; k < K; ++k)
    for (std::size_t i = 0; i < before[k].size(); ++i)
      out.residual_slopes[k][i] = (out.residual_slopes[k][i] - before[k][i]) / (2 * kShare);
  out.residuals = residuals_at(0.0);
  return out;
}

std::vector<ScoreBlock> FlightSmoother::score_blocks(double seconds) const {
  const int n = record_->layout.size, own = theta_->size(), m = static_cast<int>(shared());
  const int from = padded(n), columns = padded(m);
  const DenseRows& dense = dense_rows();
  const std::size_t K = places_.size();
  const std::vector<chunk::RowMatrix> dX = state_slopes();
  std::vector<ScoreBlock> blocks;
  std::vector<std::size_t> begin;  // first chunk of each block, and the end
  for (std::size_t k = 0; k < K; ++k) {
    const ChunkPlace& place = places_[k];
    const FlightArc& arc = record_->arcs[static_cast<std::size_t>(place.arc)];
    if (blocks.empty() || blocks.back().arc != place.arc ||
        blocks.back().to - blocks.back().from >= seconds) {
      blocks.push_back({place.arc, arc.t[place.begin], 0.0, {}, {}});
      begin.push_back(k);
    }
    blocks.back().to = arc.t[place.end];
  }
  begin.push_back(K);
  in_parallel(blocks.size(), [&](std::size_t b) {
    VectorXd score = VectorXd::Zero(columns);
    chunk::RowMatrix F = chunk::RowMatrix::Zero(m, columns), across(n, columns), along(n, columns);
    chunk::RowMatrix Et(n, n), slope(n, columns), WS(n, columns);
    for (std::size_t k = begin[b]; k < begin[b + 1]; ++k) {
      // Rows depend on the state, which follows dX, and on theta. Profiles act through links only.
      const chunk::ConstRowMap A = chunk::A(results_[k]);
      score.noalias() += dX[k].transpose() * chunk::g(results_[k]).head(n);
      score.head(own) += chunk::g(results_[k]).tail(own);
      across.setZero();
      across.leftCols(own) = A.topRightCorner(n, own);
      dense.add_upper(rows_of(F), rows_in(across), own, rows_in(dX[k]), columns, n, 1.0);
      along = across;
      dense.add_products(rows_of(along), rows_in(A), n, rows_in(dX[k]), columns, n, 1.0);
      dense.add_upper(rows_of(F), rows_in(dX[k]), m, rows_in(along), columns, n, 1.0);
      F.topLeftCorner(own, own) += A.bottomRightCorner(own, own);
      const auto add = [&](const VectorXd& W, const VectorXd& d) {
        score.noalias() += slope.transpose() * W.cwiseProduct(d);
        WS = W.asDiagonal() * slope;
        dense.add_upper(rows_of(F), rows_in(slope), m, rows_in(WS), columns, n, 1.0);
      };
      if (k == 0 || !places_[k - 1].linked) {
        slope = dX[k];
        slope.leftCols(m) -= start_slope(k);
        add(start_information(k), outside(k));
      }
      if (!places_[k].linked) continue;
      const chunk::RowMatrix& E = linearised_.E[k];
      Et = E.leftCols(n).transpose();
      slope = E.middleCols(from, columns) - dX[k + 1];
      dense.add_products(rows_of(slope), rows_in(Et), n, rows_in(dX[k]), columns, n, 1.0);
      add(link_weight(k), defect(k));
    }
    blocks[b].score = score.head(m);
    blocks[b].information = F.leftCols(m).selfadjointView<Eigen::Upper>();
  });
  return blocks;
}

}  // namespace ident
