// Links between chunks, and the elimination of all states in time order.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

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

// Derivative of the defect of chunk k over its state and the shared unknowns, the next state held.
MatrixXd FlightSmoother::link_slope(std::size_t k) const {
  const Index n = record_->layout.size, m = theta_->size();
  const VectorXd share = carried(k);
  MatrixXd E(n, n + shared());
  E.leftCols(n + m) = share.asDiagonal() * chunk::E(results_[k], record_->layout.size);
  // The floor of unmeasured rotor speeds goes with km (link_weight), so what counts is the defect over km.
  const auto& constants = theta_->constants();
  const auto km = std::ranges::find(constants, static_cast<int>(param::km), &FreeConstant::index);
  if (km != constants.end() && record_->layout.motors >= 0 && !record_->signals.rotor_speeds) {
    const Index j = km - constants.begin();
    const double relative = theta_->slope(trial_u_, static_cast<int>(j)) / theta_->p(trial_u_)[param::km];
    E.col(n + j).segment(record_->layout.motors, 2 * record_->layout.rotors) -=
        relative * defect(k).segment(record_->layout.motors, 2 * record_->layout.rotors);
  }
  // The process is what is left of the acceleration beyond the profile.
  if (!profiles_.empty()) E.rightCols(shared() - m) = profile(k + 1) - share.asDiagonal() * profile(k);
  return E;
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

// Adds the link of chunk k to its own block, and what it means for the next one to `carry`.
void FlightSmoother::add_link(std::size_t k, MatrixXd& D, MatrixXd& B, VectorXd& f, MatrixXd& U, Carry& carry,
                              ReducedSystem& sum) const {
  const Index n = record_->layout.size, m = shared();
  const MatrixXd E = link_slope(k);
  const VectorXd W = link_weight(k), d = defect(k), Wd = W.cwiseProduct(d);
  const MatrixXd WE = W.asDiagonal() * E;
  D.noalias() += E.leftCols(n).transpose() * WE.leftCols(n);
  B.noalias() += E.leftCols(n).transpose() * WE.rightCols(m);
  f.noalias() += E.leftCols(n).transpose() * Wd;
  U = -WE.leftCols(n).transpose();
  sum.S.noalias() += E.rightCols(m).transpose() * WE.rightCols(m);
  sum.g.noalias() += E.rightCols(m).transpose() * Wd;
  sum.cost += d.dot(Wd);
  carry.D = W.asDiagonal();
  carry.B = -WE.rightCols(m);
  carry.g = -Wd;
}

void FlightSmoother::eliminate_arc(std::size_t begin, std::size_t end, ReducedSystem& sum) {
  const Index n = record_->layout.size, own = theta_->size(), m = shared();
  Elimination& el = trial_elimination_;
  sum = {0.0, VectorXd::Zero(m), MatrixXd::Zero(m, m)};
  const VectorXd at_start = start_information(begin);
  Carry carry;
  MatrixXd U;
  for (std::size_t k = begin; k < end; ++k) {
    const ChunkResult& r = results_[k];
    const chunk::ConstRowMap A = chunk::A(r);
    MatrixXd D = A.topLeftCorner(n, n), B = MatrixXd::Zero(n, m);
    B.leftCols(own) = A.topRightCorner(n, own);
    VectorXd f = chunk::g(r).head(n);
    sum.S.topLeftCorner(own, own) += A.bottomRightCorner(own, own);
    sum.g.head(own) += chunk::g(r).tail(own);
    sum.cost += r.cost;
    if (carry.on) {
      D += carry.D, B += carry.B, f += carry.g;
    } else {
      const VectorXd x = outside(k);
      D.diagonal() += at_start;
      f += at_start.cwiseProduct(x);
      sum.cost += x.dot(at_start.cwiseProduct(x));
      if (m > own) {
        const MatrixXd P = profile(k), WP = at_start.asDiagonal() * P;
        B.rightCols(m - own) -= WP;
        sum.S.bottomRightCorner(m - own, m - own) += P.transpose() * WP;
        sum.g.tail(m - own) -= WP.transpose() * x;
      }
    }
    carry.on = places_[k].linked;
    if (carry.on) add_link(k, D, B, f, U, carry, sum);
    // Scaled. Damping only for states that nothing at all determines: it would pass for information on the
    // constants that move them.
    const VectorXd s = D.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    MatrixXd scaled = s.asDiagonal() * D * s.asDiagonal();
    Eigen::LLT<MatrixXd> llt(scaled);
    if (llt.info() != Eigen::Success) {
      scaled.diagonal().array() += 1e-10;
      llt.compute(scaled);
    }
    const Index c = carry.on ? n : 0;
    MatrixXd right(n, c + m + 1);
    if (carry.on) right.leftCols(n) = s.asDiagonal() * U;
    right.middleCols(c, m) = s.asDiagonal() * B;
    right.col(c + m) = s.cwiseProduct(f);
    llt.solveInPlace(right);
    const MatrixXd solved = s.asDiagonal() * right;
    if (carry.on) el.G[k] = solved.leftCols(n);
    el.B[k] = solved.middleCols(c, m);
    el.f[k] = solved.col(c + m);
    el.D_inverse[k] = s.asDiagonal() * llt.solve(MatrixXd(s.asDiagonal()));
    sum.S.noalias() -= B.transpose() * el.B[k];
    sum.g.noalias() -= B.transpose() * el.f[k];
    sum.cost -= f.dot(el.f[k]);
    if (!carry.on) continue;
    carry.D.noalias() -= U.transpose() * el.G[k];
    carry.B.noalias() -= U.transpose() * el.B[k];
    carry.g.noalias() -= U.transpose() * el.f[k];
  }
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
