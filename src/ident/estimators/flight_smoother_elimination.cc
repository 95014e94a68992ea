// Links between chunks, and the elimination of all states in time order.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ident/estimators/dense_rows.h"
#include "ident/estimators/flight_chunk_maps.h"
#include "ident/estimators/flight_smoother.h"

namespace ident {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double length(const FlightRecord& record, const ChunkPlace& place) {
  const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
  return arc.t[place.end] - arc.t[place.begin];
}

// Far below what one chunk tells of an acceleration from outside: no noise means none.
constexpr double kLeastOutside = 1e-10;

// The motors' noise reaches zero. At the floor of the other states single precision would then speak through
// their links, and the diagnosis name what is rounding.
constexpr double kMotorFloor = 100.0;

double variance(const ColouredNoise& noise) { return noise.sigma * noise.sigma + kLeastOutside; }

}  // namespace

const AirNoise& FlightSmoother::air_of(std::size_t k) const {
  return noise_.in_log(record_->arcs[static_cast<std::size_t>(places_[k].arc)].log);
}

// Share of each state component that is left at the start of the next chunk.
VectorXd FlightSmoother::carried(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  VectorXd share = VectorXd::Ones(layout.size);
  const double h = length(*record_, places_[k]);
  const AirNoise& air = air_of(k);
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    if (layout.w_dot >= 0) share[layout.w_dot + i] = air.w_dot[axis].carried(h);
    if (layout.v_dot >= 0) share[layout.v_dot + i] = air.v_dot[axis].carried(h);
  }
  return share;
}

// Information on the state at the start of an arc, before any measurement.
VectorXd FlightSmoother::start_information(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  const AirNoise& air = air_of(k);
  VectorXd info = VectorXd::Zero(layout.size);
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    if (layout.w_dot >= 0) info[layout.w_dot + i] = 1 / variance(air.w_dot[axis]);
    if (layout.v_dot >= 0) info[layout.v_dot + i] = 1 / variance(air.v_dot[axis]);
  }
  return info;
}

// The accelerations from outside within the local state of chunk k.
VectorXd FlightSmoother::outside(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  VectorXd x = VectorXd::Zero(layout.size);
  if (layout.w_dot >= 0) x.segment<3>(layout.w_dot) = trial_[k].outside.w_dot_B;
  if (layout.v_dot >= 0) x.segment<3>(layout.v_dot) = trial_[k].outside.v_dot_W;
  return x;
}

Index FlightSmoother::shared() const {
  return theta_->size() + (profiles_.empty() ? 0 : profiles_[0].cols());
}

// The profiles of chunk k within the local state.
MatrixXd FlightSmoother::profile(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  MatrixXd P = MatrixXd::Zero(layout.size, profiles_[k].cols());
  if (layout.w_dot >= 0) P.middleRows<3>(layout.w_dot) = profiles_[k].topRows<3>();
  if (layout.v_dot >= 0) P.middleRows<3>(layout.v_dot) = profiles_[k].bottomRows<3>();
  return P;
}

// Derivative of the defect of chunk k over its state, from column 0 on, and the shared unknowns, from column
// padded(n) on; the next state held.
void FlightSmoother::link_slope(std::size_t k, chunk::RowMatrix& E) const {
  const Index n = record_->layout.size, m = theta_->size(), from = padded(record_->layout.size);
  const VectorXd share = carried(k);
  const chunk::ConstRowMap whole = chunk::E(results_[k], record_->layout.size);
  E.leftCols(n) = share.asDiagonal() * whole.leftCols(n);
  E.middleCols(from, m) = share.asDiagonal() * whole.rightCols(m);
  // The floor of unmeasured rotor speeds goes with km (link_weight), so what counts is the defect over km.
  const auto& constants = theta_->constants();
  const auto km = std::ranges::find(constants, static_cast<int>(param::km), &FreeConstant::index);
  if (km != constants.end() && record_->layout.motors >= 0 && !record_->signals.rotor_speeds) {
    const Index j = km - constants.begin();
    const double relative = theta_->slope(trial_u_, static_cast<int>(j)) / theta_->p(trial_u_)[param::km];
    E.col(from + j).segment(record_->layout.motors, 2 * record_->layout.rotors) -=
        relative * defect(k).segment(record_->layout.motors, 2 * record_->layout.rotors);
  }
  // The process is what is left of the acceleration beyond the profile.
  if (!profiles_.empty())
    E.middleCols(from + m, shared() - m) = profile(k + 1) - share.asDiagonal() * profile(k);
}

// Inverse variance of the defect: what accelerations from outside win anew over a chunk, q h for rotor
// speeds, and a floor far below what the measurements of one chunk can tell, so that all else continues.
VectorXd FlightSmoother::link_weight(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  const double h = length(*record_, places_[k]),
               rows = static_cast<double>(places_[k].end - places_[k].begin);
  const auto floor = [&](int channel, double otherwise) {
    const auto c = static_cast<std::size_t>(channel);
    const double s = record_->sigma[c] != 1.0 ? noise_.sigma[c] : otherwise;  // 1: not measured
    return 1e-5 * s * s / rows;
  };
  VectorXd W(layout.size);
  const auto continues = [&](int at, int channel) {
    for (int i = 0; i < 3 && at >= 0; ++i) W[at + i] = 1.0 / floor(channel + i, 0.01);
  };
  continues(layout.w, kGyro), continues(layout.attitude, kAttitude);
  continues(layout.v, kVelocity), continues(layout.x, kPosition);
  const auto wanders = [&](int at, const std::array<ColouredNoise, 3>& noise) {
    for (int i = 0; i < 3 && at >= 0; ++i) {
      const ColouredNoise& axis = noise[static_cast<std::size_t>(i)];
      const double share = axis.carried(h);
      W[at + i] = 1.0 / (axis.sigma * axis.sigma * (1 - share * share) + kLeastOutside);
    }
  };
  wanders(layout.w_dot, air_of(k).w_dot), wanders(layout.v_dot, air_of(k).v_dot);
  const std::vector<double> p = theta_->p(trial_u_);
  const double omega_m = p[param::omega_m];
  // Rotor speeds that nobody measured are known up to a scale, that of km. The floor goes with it: else less
  // speed would mean more freedom, and the cost would fall with km.
  const double speeds = p[param::km] / theta_->p(VectorXd::Zero(theta_->size()))[param::km];
  for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n) {
    const double f = noise_.q_motor * h + kMotorFloor * floor(kRotorChannel + n, 5.0 * speeds);
    W[layout.motors + n] = 1.0 / f;
    W[layout.motors + layout.rotors + n] = 1.0 / (f * omega_m * omega_m);
  }
  return W;
}

// One arc on its way through elimination. Matrices are kept row by row, [D | B f] over states and shared
// unknowns, the second part from a column that is a multiple of kRowPad; the last column is the gradient.
struct FlightSmoother::ArcElimination {
  using Matrix = chunk::RowMatrix;

  ArcElimination(int states, int unknowns)
      : n(states),
        m(unknowns),
        from(padded(n)),
        shared(padded(m + 1)),
        own(Matrix::Zero(n, from + shared)),
        next(own),
        E(own),
        WE(own),
        U(Matrix::Zero(n, from)),
        solved(Matrix::Zero(n, from + shared + from)),
        sum(Matrix::Zero(m, shared)) {}

  static Rows rows(Matrix& M, int column = 0) { return {M.data() + column, static_cast<int>(M.cols())}; }
  static ConstRows rows(const Matrix& M, int column = 0) {
    return {M.data() + column, static_cast<int>(M.cols())};
  }
  auto D() { return own.leftCols(n); }
  auto B() { return own.middleCols(from, m); }
  auto f() { return own.col(from + m); }
  auto S() { return sum.leftCols(m); }
  auto g() { return sum.col(m); }

  int n, m, from, shared;
  Matrix own, next;  // [D | B f] of this chunk, and what it passes to the next one
  Matrix E, WE;      // slope of the link, and weighted, with the weighted defect
  Matrix U;          // over the next state
  Matrix solved;     // [U | B f | 1], then L^-1 of it, then D^-1 of it
  Matrix sum;        // [S g]
  double cost = 0.0;
};

// What is known of the accelerations from outside where an arc begins.
void FlightSmoother::add_start(std::size_t k, ArcElimination& arc) const {
  const VectorXd info = start_information(k), x = outside(k);
  const Index own = theta_->size(), further = shared() - own;
  arc.D().diagonal() += info;
  arc.f() += info.cwiseProduct(x);
  arc.cost += x.dot(info.cwiseProduct(x));
  if (further == 0) return;
  const MatrixXd P = profile(k), WP = info.asDiagonal() * P;
  arc.B().rightCols(further) -= WP;
  arc.S().bottomRightCorner(further, further) += P.transpose() * WP;
  arc.g().tail(further) -= WP.transpose() * x;
}

// Adds the link of chunk k to its own block, and what it means for the next one to that.
void FlightSmoother::add_link(std::size_t k, ArcElimination& arc) const {
  const int n = arc.n, m = arc.m;
  link_slope(k, arc.E);
  const VectorXd W = link_weight(k), d = defect(k);
  arc.WE = W.asDiagonal() * arc.E;
  arc.WE.col(arc.from + m) = W.cwiseProduct(d);
  const auto E = [&](int column) { return ArcElimination::rows(std::as_const(arc.E), column); };
  const auto WE = [&](int column) { return ArcElimination::rows(std::as_const(arc.WE), column); };
  const DenseRows& dense = dense_rows();
  dense.add_products(ArcElimination::rows(arc.own), E(0), n, WE(0), arc.from + arc.shared, n, 1.0);
  dense.add_products(ArcElimination::rows(arc.sum), E(arc.from), m, WE(arc.from), arc.shared, n, 1.0);
  arc.cost += d.dot(W.cwiseProduct(d));
  arc.U.leftCols(n) = -arc.WE.leftCols(n).transpose();
  arc.next = -arc.WE;
  arc.next.leftCols(n) = W.asDiagonal();
}

void FlightSmoother::eliminate_arc(std::size_t begin, std::size_t end, ReducedSystem& sum) {
  const int n = record_->layout.size, own = theta_->size(), m = static_cast<int>(shared());
  Elimination& el = trial_elimination_;
  ArcElimination arc(n, m);
  const int from = arc.from, right = from + arc.shared;
  const DenseRows& dense = dense_rows();
  const auto solved = [&](int column) { return ArcElimination::rows(std::as_const(arc.solved), column); };
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
    arc.B().leftCols(own) += A.topRightCorner(n, own);
    arc.f() += chunk::g(r).head(n);
    arc.S().topLeftCorner(own, own) += A.bottomRightCorner(own, own);
    arc.g().head(own) += chunk::g(r).tail(own);
    arc.cost += r.cost;
    const bool linked = places_[k].linked;
    if (linked)
      add_link(k, arc);
    else
      arc.U.setZero();
    // Damping only for states that nothing at all determines: it would pass for information on the constants
    // that move them.
    Eigen::LLT<ArcElimination::Matrix> llt(arc.D());
    if (llt.info() != Eigen::Success) {
      arc.D().diagonal() += 1e-10 * arc.D().diagonal().cwiseMax(1e-200);
      llt.compute(arc.D());
    }
    const ArcElimination::Matrix& L = llt.matrixLLT();
    arc.solved.leftCols(from) = arc.U;
    arc.solved.middleCols(from, arc.shared) = arc.own.rightCols(arc.shared);
    arc.solved.middleCols(right, n).setIdentity();
    dense.forward(ArcElimination::rows(L), n, ArcElimination::rows(arc.solved), right + from);
    dense.add_products(ArcElimination::rows(arc.sum), solved(from), m, solved(from), arc.shared, n, -1.0);
    arc.cost -= arc.solved.col(from + m).squaredNorm();
    if (linked) dense.add_products(ArcElimination::rows(arc.next), solved(0), n, solved(0), right, n, -1.0);
    dense.backward(ArcElimination::rows(L), n, ArcElimination::rows(arc.solved), right + from);
    if (linked) el.G[k] = arc.solved.leftCols(n);
    el.B[k] = arc.solved.middleCols(from, m);
    el.f[k] = arc.solved.col(from + m);
    el.D_inverse[k] = arc.solved.middleCols(right, n);
  }
  sum = {arc.cost, arc.g(), arc.S()};
}

void FlightSmoother::eliminate() {
  Elimination& el = trial_elimination_;
  const std::size_t K = places_.size(), arcs = arc_begin_.size() - 1;
  el.G.resize(K), el.B.resize(K), el.f.resize(K), el.D_inverse.resize(K);
  std::vector<ReducedSystem> parts(arcs);
  in_parallel(arcs, [&](std::size_t a) { eliminate_arc(arc_begin_[a], arc_begin_[a + 1], parts[a]); });
  reduced_ = {0.0, VectorXd::Zero(shared()), MatrixXd::Zero(shared(), shared())};
  for (const ReducedSystem& part : parts)
    reduced_.cost += part.cost, reduced_.g += part.g, reduced_.S += part.S;
  reduced_.S = 0.5 * (reduced_.S + reduced_.S.transpose()).eval();
}

// Backward recursion for the posterior covariance of each state and of neighbours, shared unknowns held.
void FlightSmoother::posterior_covariances(Elimination& el) const {
  const std::size_t K = places_.size();
  el.P.resize(K);
  el.cross.resize(K);
  in_parallel(arc_begin_.size() - 1, [&](std::size_t a) {
    for (std::size_t k = arc_begin_[a + 1]; k-- > arc_begin_[a];) {
      el.P[k] = el.D_inverse[k];
      if (!places_[k].linked) continue;
      el.cross[k].noalias() = -el.G[k] * el.P[k + 1];
      el.P[k].noalias() -= el.cross[k] * el.G[k].transpose();
    }
  });
}

// Steps of all states to the optimum of the last linearisation, shared unknowns and their priors included.
std::vector<VectorXd> FlightSmoother::optimum() const {
  const PriorTerms prior = theta_->prior(trial_u_);
  MatrixXd H = reduced_.S;
  // Directions that the data do not tell stay where they are: no further than some units without a prior.
  H.diagonal() += prior.slope.cwiseAbs2().cwiseMax(1e-2);
  const VectorXd s = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = s.asDiagonal() * H * s.asDiagonal();
  scaled.diagonal().array() += 1e-7;
  const VectorXd g = reduced_.g + prior.slope.cwiseProduct(prior.residual);
  const VectorXd du =
      theta_->size() > 0
          ? VectorXd(-(s.asDiagonal() * Eigen::LLT<MatrixXd>(scaled).solve(VectorXd(s.asDiagonal() * g))))
          : VectorXd(0);
  const Elimination& el = trial_elimination_;
  std::vector<VectorXd> dx(places_.size());
  for (std::size_t k = places_.size(); k-- > 0;) {
    dx[k] = -(el.f[k] + el.B[k] * du);
    if (places_[k].linked) dx[k] -= el.G[k] * dx[k + 1];
  }
  dx.push_back(du);
  return dx;
}

}  // namespace ident
