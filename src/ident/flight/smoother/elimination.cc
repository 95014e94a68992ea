// Eliminates all states in time order, those of a long chain from both ends at once.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ident/core/simd/dense_rows.h"
#include "ident/core/stage_times.h"
#include "ident/flight/smoother/chunk_maps.h"
#include "ident/flight/smoother/smoother.h"

namespace ident {

using chunk::rows_in;
using chunk::rows_of;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Chains of more chunks are eliminated from both ends.
constexpr std::size_t kLongChain = 40;

FlightSmoother::Chain FlightSmoother::chain_of(std::size_t begin, std::size_t end) {
  const bool is_long = end - begin > kLongChain;
  return {begin, is_long ? begin + (end - begin) / 2 : end - 1, end};
}

// One end of a chain during elimination. Matrices are kept row by row, [D | B f] over states and shared
// unknowns; the second part begins at a column that is a multiple of kRowPad, and its last column is the
// gradient.
struct FlightSmoother::Sweep {
  using Matrix = chunk::RowMatrix;

  Sweep(int states, int unknowns)
      : n(states),
        m(unknowns),
        from(padded(n)),
        shared(padded(m + 1)),
        own(Matrix::Zero(n, from + shared)),
        next(own),
        WE(own),
        U(Matrix::Zero(n, from)),
        GBf(n, from + shared),
        sum(Matrix::Zero(m, shared)) {}

  auto D() { return own.leftCols(n); }
  auto B() { return own.middleCols(from, m); }
  auto f() { return own.col(from + m); }
  auto S() { return sum.leftCols(m); }
  auto g() { return sum.col(m); }

  int n, m, from, shared;
  Matrix own, next;  // [D | B f] of this chunk, and what it passes to the next one
  Matrix WE;         // weighted slope of the link, with the weighted defect
  Matrix U;          // over the state that is next in the sweep
  Matrix GBf;        // [U | B f], then L^-1 of it, then D^-1 of it
  Matrix sum;        // [S g], of S what is right of its diagonal
  double cost = 0.0, fall = 0.0, log_det = 0.0;
};

// Damps only states whose pivot is lost to rounding, which nothing determines. Damping of any other state
// would count as information on the constants that move it.
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

// Adds the prior information on the state where an arc begins.
void FlightSmoother::add_start(std::size_t k, Sweep& at, bool held) const {
  const VectorXd info = start_information(k);
  VectorXd x = outside(k);
  const MatrixXd slope = start_slope(k);
  if (held) x -= slope * linearised_.held;
  at.D().diagonal() += info;
  at.f() += info.cwiseProduct(x);
  at.cost += x.dot(info.cwiseProduct(x));
  for (const double one : info)
    if (one > 0) at.log_det -= std::log(one);
  if (held) return;
  const MatrixXd W_slope = info.asDiagonal() * slope;
  at.B() -= W_slope;
  at.S() += slope.transpose() * W_slope;
  at.g() -= W_slope.transpose() * x;
}

// Begins chunk k: what the sweep passed on to it, and the information of its rows.
void FlightSmoother::add_rows(std::size_t k, Sweep& at, bool held) const {
  const int n = at.n, own = theta_->size();
  const ChunkResult& r = results_[k];
  const chunk::ConstRowMap A = chunk::A(r);
  const DenseRows& dense = dense_rows();
  std::swap(at.own, at.next);
  if (k == 0 || !places_[k - 1].linked) add_start(k, at, held);
  dense.add(rows_of(at.own), rows_in(A), n, n);
  at.f() += chunk::g(r).head(n);
  if (held)
    at.f() += linearised_.f[k];
  else
    dense.add(rows_of(at.own, at.from), {A.data() + n, A.cols()}, n, own);
  at.cost += r.cost;
}

// Adds the link from chunk k to the next: its part for the chunk that the sweep is at, and its part for the
// neighbour.
void FlightSmoother::add_link(std::size_t k, Sweep& at, bool forward, bool held) {
  const int n = at.n, m = at.m, from = at.from, right = from + at.shared;
  chunk::RowMatrix& slope = linearised_.E[k];
  set_shares(k, slope);
  const VectorXd W = link_weight(k);
  VectorXd d = defect(k);
  if (held) d += linearised_.d[k];
  const DenseRows& dense = dense_rows();
  dense.scale(rows_of(at.WE), W.data(), rows_in(slope), n, held ? from : right);
  at.WE.col(from + m) = W.cwiseProduct(d);
  const auto E = [&](int column) { return rows_in(slope, column); };
  const auto WE = [&](int column) { return rows_in(at.WE, column); };
  at.next.setZero();
  Sweep::Matrix &before = forward ? at.own : at.next, &after = forward ? at.next : at.own;
  dense.add_products(rows_of(before), E(0), n, WE(0), right, n, 1.0);
  after.leftCols(n).diagonal() += W;
  after.middleCols(from, m + 1) -= at.WE.middleCols(from, m + 1);
  dense.add_upper(rows_of(at.sum), E(from), m, WE(from), at.shared, n, 1.0);
  at.cost += d.dot(W.cwiseProduct(d));
  at.log_det -= W.array().log().sum();
  if (forward)
    at.U.leftCols(n) = -at.WE.leftCols(n).transpose();
  else
    at.U.leftCols(n) = -at.WE.leftCols(n);
}

// Eliminates chunk k. `linked`: to the chunk that is next in the sweep.
void FlightSmoother::eliminate_chunk(std::size_t k, Sweep& at, bool linked) {
  const int n = at.n, m = at.m, from = at.from, right = from + at.shared;
  Elimination& el = last();
  const DenseRows& dense = dense_rows();
  Sweep::Matrix& GBf = at.GBf;
  const auto solved = [&](int column) { return rows_in(GBf, column); };
  Eigen::LLT<Sweep::Matrix> llt(at.D());
  if (llt.info() != Eigen::Success) {
    damp_undetermined(at.own, n);
    llt.compute(at.D());
  }
  const Sweep::Matrix& L = el.L[k] = llt.matrixLLT();
  at.log_det += 2 * L.diagonal().array().log().sum();
  if (linked)
    GBf.leftCols(from) = at.U;
  else
    GBf.leftCols(from).setZero();
  GBf.rightCols(at.shared) = at.own.rightCols(at.shared);
  dense.forward(rows_in(L), n, rows_of(GBf), right);
  dense.add_upper(rows_of(at.sum), solved(from), m, solved(from), at.shared, n, -1.0);
  at.fall += GBf.col(from + m).squaredNorm();
  if (linked) dense.add_products(rows_of(at.next), solved(0), n, solved(0), right, n, -1.0);
  dense.backward(rows_in(L), n, rows_of(GBf), right);
  if (linked) {
    el.Gt[k].setZero(n, from);
    el.Gt[k].leftCols(n) = GBf.leftCols(n).transpose();
  }
  el.B[k] = GBf.middleCols(from, m);
  el.f[k] = GBf.col(from + m);
}

// Eliminates the chunks of a chain on one side of the meeting point; null where there is none.
std::unique_ptr<FlightSmoother::Sweep> FlightSmoother::sweep(const Chain& chain, bool forward, bool held) {
  if ((forward ? chain.begin : chain.end - 1) == chain.meet) return nullptr;
  auto at = std::make_unique<Sweep>(record_->layout.size, held ? 0 : static_cast<int>(shared()));
  for (std::size_t k = forward ? chain.begin : chain.end - 1; k != chain.meet; forward ? ++k : --k) {
    add_rows(k, *at, held);
    add_link(forward ? k : k - 1, *at, forward, held);
    eliminate_chunk(k, *at, true);
  }
  return at;
}

// Prepares what all eliminations of a linearisation share: slopes of the links, and the information of the
// rows on theta.
void FlightSmoother::begin_eliminations() {
  if (linearised_.stands) return;
  const Index own = theta_->size();
  linearised_.stands = true, linearised_.held.resize(0);
  linearised_.E.resize(places_.size());
  in_parallel(places_.size(), [&](std::size_t k) {
    if (places_[k].linked) linearised_.E[k] = link_slope(k);
  });
  linearised_.S.assign(chains_.size(), MatrixXd::Zero(own, own));
  linearised_.g.assign(chains_.size(), VectorXd::Zero(own));
  in_parallel(chains_.size(), [&](std::size_t c) {
    for (std::size_t k = chains_[c].begin; k < chains_[c].end; ++k) {
      linearised_.S[c] += chunk::A(results_[k]).bottomRightCorner(own, own);
      linearised_.g[c] += chunk::g(results_[k]).tail(own);
    }
  });
}

// Prepares a step of the shared unknowns that the next eliminations hold. Slopes over profiles change with
// the noise.
void FlightSmoother::hold(const VectorXd& du) {
  if (profiles_.empty() && linearised_.held.size() == du.size() && linearised_.held == du) return;
  const Index n = record_->layout.size, from = padded(record_->layout.size);
  linearised_.held = du;
  linearised_.f.resize(places_.size()), linearised_.d.resize(places_.size());
  in_parallel(places_.size(), [&](std::size_t k) {
    linearised_.f[k] = chunk::A(results_[k]).topRightCorner(n, theta_->size()) * du.head(theta_->size());
    if (!places_[k].linked) return;
    if (!profiles_.empty()) set_shares(k, linearised_.E[k]);
    linearised_.d[k] = linearised_.E[k].middleCols(from, du.size()) * du;
  });
}

void FlightSmoother::eliminate(const VectorXd* held_step) {
  const Stage stage("states eliminated");
  const bool held = held_step != nullptr;
  begin_eliminations();
  if (held) hold(*held_step);
  eliminated_ = !held;
  if (last_at_ == accepted_at_) last_at_ = 1 - accepted_at_;
  Elimination& el = last();
  const std::size_t K = places_.size();
  el.B.resize(K), el.Gt.resize(K), el.f.resize(K), el.L.resize(K);
  el.held = held;
  if (covariances_.of == last_at_) covariances_.of.reset();
  std::vector<std::array<std::unique_ptr<Sweep>, 2>> ends(chains_.size());
  in_parallel(2 * chains_.size(),
              [&](std::size_t i) { ends[i / 2][i % 2] = sweep(chains_[i / 2], i % 2 == 0, held); });
  std::vector<ReducedSystem> parts(chains_.size());
  in_parallel(chains_.size(), [&](std::size_t c) {
    auto& [at, other] = ends[c];
    if (!at) std::swap(at, other);
    if (!at) at = std::make_unique<Sweep>(record_->layout.size, held ? 0 : static_cast<int>(shared()));
    if (other) at->next += other->next, at->sum += other->sum;
    if (other) at->cost += other->cost, at->fall += other->fall, at->log_det += other->log_det;
    add_rows(chains_[c].meet, *at, held);
    eliminate_chunk(chains_[c].meet, *at, false);
    parts[c] = {at->cost - at->fall, at->fall, at->g(), at->S(), at->log_det};
    if (!held) {
      const Index own = theta_->size();
      parts[c].S.topLeftCorner(own, own) += linearised_.S[c], parts[c].g.head(own) += linearised_.g[c];
    }
    ends[c] = {};
  });
  if (held) return;
  reduced_ = {0.0, 0.0, VectorXd::Zero(shared()), MatrixXd::Zero(shared(), shared()), 0.0};
  for (const ReducedSystem& part : parts) {
    reduced_.cost += part.cost, reduced_.fall += part.fall, reduced_.log_det += part.log_det;
    reduced_.g += part.g, reduced_.S += part.S;
  }
  reduced_.S.triangularView<Eigen::StrictlyLower>() = reduced_.S.transpose();
}

}  // namespace ident
