// Back substitution after an elimination: covariances, steps and slopes of the states.
#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "ident/core/simd/dense_rows.h"
#include "ident/flight/smoother/chunk_maps.h"
#include "ident/flight/smoother/smoother.h"

namespace ident {

using chunk::rows_in;
using chunk::rows_of;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Covariance of the state of chunk k from what was eliminated before it.
chunk::RowMatrix FlightSmoother::own_covariance(const Elimination& el, std::size_t k) const {
  const int n = record_->layout.size, columns = padded(n);
  const DenseRows& dense = dense_rows();
  chunk::RowMatrix P = chunk::RowMatrix::Identity(n, columns);
  dense.forward(rows_in(el.L[k]), n, rows_of(P), columns);
  dense.backward(rows_in(el.L[k]), n, rows_of(P), columns);
  return P;
}

// Visits all chunks of each chain in the reverse order of their elimination, each with the neighbour that was
// next in the sweep; the meeting point has none.
void FlightSmoother::outward(
    const std::function<void(std::size_t, std::optional<std::size_t>)>& visit) const {
  in_parallel(chains_.size(), [&](std::size_t c) { visit(chains_[c].meet, std::nullopt); });
  in_parallel(2 * chains_.size(), [&](std::size_t i) {
    const Chain& chain = chains_[i / 2];
    if (i % 2 == 0)
      for (std::size_t k = chain.meet; k-- > chain.begin;) visit(k, k + 1);
    else
      for (std::size_t k = chain.meet + 1; k < chain.end; ++k) visit(k, k - 1);
  });
}

// By recursion from the meeting point outward.
const FlightSmoother::Covariances& FlightSmoother::covariances_by(std::size_t elimination) {
  Covariances& all = covariances_;
  if (all.of == elimination) return all;
  all.of = elimination;
  all.P.resize(places_.size()), all.cross.resize(places_.size());
  const Elimination& el = eliminations_[elimination];
  const int n = record_->layout.size, columns = padded(n);
  const DenseRows& dense = dense_rows();
  outward([&](std::size_t k, std::optional<std::size_t> next) {
    all.P[k] = own_covariance(el, k);
    if (!next) return;
    chunk::RowMatrix cross = chunk::RowMatrix::Zero(n, columns);  // of the next one and this
    dense.add_products(rows_of(cross), rows_in(all.P[*next]), n, rows_in(el.Gt[k]), columns, n, -1.0);
    dense.add_products(rows_of(all.P[k]), rows_in(cross), n, rows_in(el.Gt[k]), columns, n, -1.0);
    if (*next < k) cross.leftCols(n).transposeInPlace();
    all.cross[std::min(k, *next)] = std::move(cross);
  });
  return all;
}

// Step of the shared unknowns to the optimum of the last linearisation, priors included.
VectorXd FlightSmoother::shared_optimum() const {
  if (theta_->size() == 0) return VectorXd(0);
  const PriorTerms prior = theta_->prior(trial_u_);
  // Undetermined directions stay where they are: without a prior they move by a few units at most.
  const MatrixXd H = reduced_.S + prior.information(1e-2);
  const VectorXd s = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = s.asDiagonal() * H * s.asDiagonal();
  scaled.diagonal().array() += 1e-7;
  const VectorXd g = reduced_.g + prior.gradient();
  return -(s.asDiagonal() * Eigen::LLT<MatrixXd>(scaled).solve(VectorXd(s.asDiagonal() * g)));
}

// Steps of the states that follow a step of the shared unknowns, by an elimination that may have held it.
std::vector<VectorXd> FlightSmoother::state_steps(const Elimination& el, const VectorXd& du) const {
  std::vector<VectorXd> dx(places_.size());
  outward([&](std::size_t k, std::optional<std::size_t> next) {
    dx[k] = -el.f[k];
    if (!el.held) dx[k].noalias() -= el.B[k] * du;
    if (next) dx[k].noalias() -= el.Gt[k].leftCols(dx[k].size()).transpose() * dx[*next];
  });
  return dx;
}

// Derivative of the accepted states, at their optimum, over the shared unknowns; rows are padded.
std::vector<chunk::RowMatrix> FlightSmoother::state_slopes() const {
  const int n = record_->layout.size, m = padded(static_cast<int>(shared()));
  const DenseRows& dense = dense_rows();
  std::vector<chunk::RowMatrix> dX(places_.size());
  outward([&](std::size_t k, std::optional<std::size_t> next) {
    dX[k] = chunk::RowMatrix::Zero(n, m);
    dX[k].leftCols(shared()) = -accepted().B[k];
    if (next)
      dense.add_products(rows_of(dX[k]), rows_in(accepted().Gt[k]), n, rows_in(dX[*next]), m, n, -1.0);
  });
  return dX;
}

}  // namespace ident
