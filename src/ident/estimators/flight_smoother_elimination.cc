// The elimination of all states in time order.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ident/estimators/dense_rows.h"
#include "ident/estimators/flight_chunk_maps.h"
#include "ident/estimators/flight_smoother.h"

namespace ident {

using chunk::rows_in;
using chunk::rows_of;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// One arc on its way through elimination. Matrices are kept row by row, [D | B f] over states and shared
// unknowns, the second part from a column that is a multiple of kRowPad; the last column is the gradient.
struct FlightSmoother::ArcElimination {
  using Matrix = chunk::RowMatrix;

  /// `slopes`: shared unknowns that links have slopes over, `unknowns` or more.
  ArcElimination(int states, int unknowns, int slopes)
      : n(states),
        m(unknowns),
        from(padded(n)),
        shared(padded(m + 1)),
        own(Matrix::Zero(n, from + shared)),
        next(own),
        E(Matrix::Zero(n, from + padded(slopes + 1))),
        WE(own),
        U(Matrix::Zero(n, from)),
        solved(Matrix::Zero(n, from + shared)),
        sum(Matrix::Zero(m, shared)) {}

  auto D() { return own.leftCols(n); }
  auto B() { return own.middleCols(from, m); }
  auto f() { return own.col(from + m); }
  auto S() { return sum.leftCols(m); }
  auto g() { return sum.col(m); }

  int n, m, from, shared;
  Matrix own, next;  // [D | B f] of this chunk, and what it passes to the next one
  Matrix E, WE;      // slope of the link, and weighted, with the weighted defect
  Matrix U;          // over the next state
  Matrix solved;     // [U | B f], then L^-1 of it, then D^-1 of it
  Matrix sum;        // [S g]
  double cost = 0.0, log_det = 0.0;
};

// Damping only for states that nothing at all determines, those whose pivot is lost to rounding: of any other
// it would pass for information on the constants that move it.
void FlightSmoother::damp_undetermined(chunk::RowMatrix& D, int n) {
  constexpr double kRounding = 1e-13, kDamping = 1e-10;
  MatrixXd L = MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) L(i, k) = (D(i, k) - L.row(i).head(k).dot(L.row(k).head(k))) / L(k, k);
    const double least = kRounding * std::max(D(i, i), 1e-200);
    double pivot = D(i, i) - L.row(i).head(i).squaredNorm();
    if (!(pivot > least)) {
      const double damping = kDamping * std::max(D(i, i), 1e-200);
      D(i, i) += damping, pivot = std::max(pivot, 0.0) + damping;
    }
    L(i, i) = std::sqrt(pivot);
  }
}

// What is known of the accelerations from outside where an arc begins.
void FlightSmoother::add_start(std::size_t k, ArcElimination& arc) const {
  const VectorXd info = start_information(k), x = outside(k);
  const Index own = theta_->size(), further = shared() - own;
  arc.D().diagonal() += info;
  arc.f() += info.cwiseProduct(x);
  arc.cost += x.dot(info.cwiseProduct(x));
  for (const double one : info)
    if (one > 0) arc.log_det -= std::log(one);
  if (further == 0) return;
  const MatrixXd P = profile(k), WP = info.asDiagonal() * P;
  arc.B().rightCols(further) -= WP;
  arc.S().bottomRightCorner(further, further) += P.transpose() * WP;
  arc.g().tail(further) -= WP.transpose() * x;
}

// Adds the link of chunk k to its own block, and what it means for the next one to that.
void FlightSmoother::add_link(std::size_t k, ArcElimination& arc, const VectorXd* held) const {
  const int n = arc.n, m = arc.m;
  link_slope(k, arc.E);
  const VectorXd W = link_weight(k);
  VectorXd d = defect(k);
  if (held) d.noalias() += arc.E.middleCols(arc.from, held->size()) * *held;
  arc.WE.leftCols(n) = W.asDiagonal() * arc.E.leftCols(n);
  arc.WE.middleCols(arc.from, m) = W.asDiagonal() * arc.E.middleCols(arc.from, m);
  arc.WE.col(arc.from + m) = W.cwiseProduct(d);
  const auto E = [&](int column) { return rows_in(arc.E, column); };
  const auto WE = [&](int column) { return rows_in(arc.WE, column); };
  const DenseRows& dense = dense_rows();
  dense.add_products(rows_of(arc.own), E(0), n, WE(0), arc.from + arc.shared, n, 1.0);
  dense.add_products(rows_of(arc.sum), E(arc.from), m, WE(arc.from), arc.shared, n, 1.0);
  arc.cost += d.dot(W.cwiseProduct(d));
  arc.log_det -= W.array().log().sum();
  arc.U.leftCols(n) = -arc.WE.leftCols(n).transpose();
  arc.next = -arc.WE;
  arc.next.leftCols(n) = W.asDiagonal();
}

void FlightSmoother::eliminate_arc(std::size_t begin, std::size_t end, ReducedSystem& sum,
                                   const VectorXd* held) {
  const int n = record_->layout.size, own = theta_->size(), all = static_cast<int>(shared());
  const int m = held ? 0 : all;
  Elimination& el = last();
  ArcElimination arc(n, m, all);
  const int from = arc.from, right = from + arc.shared;
  const DenseRows& dense = dense_rows();
  const auto solved = [&](int column) { return rows_in(arc.solved, column); };
  for (std::size_t k = begin; k < end; ++k) {
    const ChunkResult& r = results_[k];
    const chunk::ConstRowMap A = chunk::A(r);
    std::swap(arc.own, arc.next);
    const bool first = k == begin || !places_[k - 1].linked;
    if (first) {
      arc.own.setZero();
      add_start(k, arc);
    }
    arc.D() += A.topLeftCorner(n, n);
    arc.f() += chunk::g(r).head(n);
    if (held) {
      arc.f().noalias() += A.topRightCorner(n, own) * *held;
    } else {
      arc.B().leftCols(own) += A.topRightCorner(n, own);
      arc.S().topLeftCorner(own, own) += A.bottomRightCorner(own, own);
      arc.g().head(own) += chunk::g(r).tail(own);
    }
    arc.cost += r.cost;
    const bool linked = places_[k].linked;
    if (linked)
      add_link(k, arc, held);
    else
      arc.U.setZero();
    Eigen::LLT<ArcElimination::Matrix> llt(arc.D());
    if (llt.info() != Eigen::Success) {
      damp_undetermined(arc.own, n);
      llt.compute(arc.D());
    }
    const ArcElimination::Matrix& L = el.L[k] = llt.matrixLLT();
    arc.log_det += 2 * L.diagonal().array().log().sum();
    arc.solved.leftCols(from) = arc.U;
    arc.solved.middleCols(from, arc.shared) = arc.own.rightCols(arc.shared);
    dense.forward(rows_in(L), n, rows_of(arc.solved), right);
    dense.add_products(rows_of(arc.sum), solved(from), m, solved(from), arc.shared, n, -1.0);
    arc.cost -= arc.solved.col(from + m).squaredNorm();
    if (linked) dense.add_products(rows_of(arc.next), solved(0), n, solved(0), right, n, -1.0);
    dense.backward(rows_in(L), n, rows_of(arc.solved), right);
    if (linked) {
      el.Gt[k].setZero(n, from);
      el.Gt[k].leftCols(n) = arc.solved.leftCols(n).transpose();
    }
    el.B[k] = arc.solved.middleCols(from, padded(m));
    el.B[k].rightCols(padded(m) - m).setZero();
    el.f[k] = arc.solved.col(from + m);
  }
  sum = {arc.cost, arc.g(), arc.S(), arc.log_det};
}

void FlightSmoother::eliminate(const VectorXd* held) {
  eliminated_ = held == nullptr;
  if (last_at_ == accepted_at_) last_at_ = 1 - accepted_at_;
  Elimination& el = last();
  const std::size_t K = places_.size(), arcs = arc_begin_.size() - 1;
  el.Gt.resize(K), el.B.resize(K), el.f.resize(K), el.L.resize(K), el.P.resize(K), el.cross.resize(K);
  el.smoothed = false;
  std::vector<ReducedSystem> parts(arcs);
  in_parallel(arcs, [&](std::size_t a) { eliminate_arc(arc_begin_[a], arc_begin_[a + 1], parts[a], held); });
  if (held) return;
  reduced_ = {0.0, VectorXd::Zero(shared()), MatrixXd::Zero(shared(), shared()), 0.0};
  for (const ReducedSystem& part : parts) {
    reduced_.cost += part.cost, reduced_.g += part.g, reduced_.S += part.S;
    reduced_.log_det += part.log_det;
  }
  reduced_.S = 0.5 * (reduced_.S + reduced_.S.transpose()).eval();
}

// Covariance of the state of chunk k, from the arc before the next one.
chunk::RowMatrix FlightSmoother::past_covariance(const Elimination& el, std::size_t k) const {
  const int n = record_->layout.size, columns = padded(n);
  const DenseRows& dense = dense_rows();
  chunk::RowMatrix P = chunk::RowMatrix::Identity(n, columns);
  dense.forward(rows_in(el.L[k]), n, rows_of(P), columns);
  dense.backward(rows_in(el.L[k]), n, rows_of(P), columns);
  return P;
}

// Backward recursion for the posterior covariance of each state and of neighbours, shared unknowns held.
void FlightSmoother::posterior_covariances(Elimination& el) const {
  if (el.smoothed) return;
  el.smoothed = true;
  const int n = record_->layout.size;
  const DenseRows& dense = dense_rows();
  in_parallel(places_.size(), [&](std::size_t k) { el.P[k] = past_covariance(el, k); });
  in_parallel(arc_begin_.size() - 1, [&](std::size_t a) {
    for (std::size_t k = arc_begin_[a + 1]; k-- > arc_begin_[a];) {
      if (!places_[k].linked) continue;
      el.cross[k].setZero(n, padded(n));
      dense.add_products(rows_of(el.cross[k]), rows_in(el.P[k + 1]), n, rows_in(el.Gt[k]), padded(n), n,
                         -1.0);
      dense.add_products(rows_of(el.P[k]), rows_in(el.cross[k]), n, rows_in(el.Gt[k]), padded(n), n, -1.0);
    }
  });
}

// Steps of the shared unknowns to the optimum of the last linearisation, priors included.
VectorXd FlightSmoother::shared_optimum() const {
  if (theta_->size() == 0) return VectorXd(0);
  const PriorTerms prior = theta_->prior(trial_u_);
  MatrixXd H = reduced_.S;
  // Directions that the data do not tell stay where they are: no further than some units without a prior.
  H.diagonal() += prior.slope.cwiseAbs2().cwiseMax(1e-2);
  const VectorXd s = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = s.asDiagonal() * H * s.asDiagonal();
  scaled.diagonal().array() += 1e-7;
  const VectorXd g = reduced_.g + prior.slope.cwiseProduct(prior.residual);
  return -(s.asDiagonal() * Eigen::LLT<MatrixXd>(scaled).solve(VectorXd(s.asDiagonal() * g)));
}

// Steps of the states for that of the shared unknowns: by the last elimination, which may have held it.
std::vector<VectorXd> FlightSmoother::state_steps(const VectorXd& du) const {
  const Elimination& el = last();
  std::vector<VectorXd> dx(places_.size());
  for (std::size_t k = places_.size(); k-- > 0;) {
    dx[k] = -el.f[k];
    if (el.B[k].cols() > 0) dx[k].noalias() -= el.B[k].leftCols(du.size()) * du;
    if (places_[k].linked) dx[k].noalias() -= el.Gt[k].leftCols(dx[k].size()).transpose() * dx[k + 1];
  }
  return dx;
}

// Derivative of the accepted states, at their best, over the shared unknowns; rows are padded.
std::vector<chunk::RowMatrix> FlightSmoother::state_slopes() const {
  const int n = record_->layout.size, m = padded(static_cast<int>(shared()));
  const DenseRows& dense = dense_rows();
  std::vector<chunk::RowMatrix> dX(places_.size());
  in_parallel(arc_begin_.size() - 1, [&](std::size_t a) {
    for (std::size_t k = arc_begin_[a + 1]; k-- > arc_begin_[a];) {
      dX[k] = -accepted().B[k];
      if (places_[k].linked)
        dense.add_products(rows_of(dX[k]), rows_in(accepted().Gt[k]), n, rows_in(dX[k + 1]), m, n, -1.0);
    }
  });
  return dX;
}

}  // namespace ident
