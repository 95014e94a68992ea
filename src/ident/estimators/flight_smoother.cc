// Parallel evaluation, links and elimination of the chain of chunks.
#include "ident/estimators/flight_smoother.h"

#include <Eigen/Cholesky>
#include <atomic>
#include <cmath>
#include <thread>

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using ConstRowMap = Eigen::Map<const RowMatrix>;

ConstRowMap map_A(const ChunkResult& r) {
  const auto d = static_cast<Index>(r.g.size());
  return {r.A.data(), d, d};
}
ConstRowMap map_E(const ChunkResult& r, int n) { return {r.E.data(), n, static_cast<Index>(r.g.size())}; }
Eigen::Map<const VectorXd> map_g(const ChunkResult& r) {
  return {r.g.data(), static_cast<Index>(r.g.size())};
}

}  // namespace

FlightSmoother::FlightSmoother(const FlightRecord& record, const Theta& theta, NoiseModel noise,
                               double chunk_seconds, int threads)
    : record_(&record), theta_(&theta), noise_(noise), chunk_seconds_(chunk_seconds), threads_(threads) {
  if (threads_ <= 0) threads_ = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    std::size_t begin = 0;
    while (begin + 1 < arc.rows()) {
      std::size_t end = begin + 1;
      while (end + 1 < arc.rows() && arc.t[end] - arc.t[begin] < chunk_seconds - 1e-9) ++end;
      if (arc.rows() - 1 - end < (end - begin) / 2) end = arc.rows() - 1;  // no tiny rest
      places_.push_back({static_cast<int>(a), begin, end, end + 1 < arc.rows()});
      states_.push_back(arc.start[begin]);
      begin = end;
    }
  }
  results_.resize(places_.size());
  trial_ = states_;
  u_ = trial_u_ = VectorXd::Zero(theta.size());
}

void FlightSmoother::set_noise(const NoiseModel& noise) { noise_ = noise; }

ChunkTask FlightSmoother::task(std::size_t k, const VectorXd& u, const std::vector<double>& p,
                               const std::vector<std::vector<Seed>>& seeds) const {
  const ChunkPlace& place = places_[k];
  const FlightArc& arc = record_->arcs[static_cast<std::size_t>(place.arc)];
  ChunkTask task;
  task.vehicle = record_->vehicle;
  task.inputs = &arc.inputs;
  task.layout = record_->layout;
  task.p = p;
  task.gyro_bias = theta_->gyro_bias(u, arc.log);
  task.seeds = seeds[static_cast<std::size_t>(arc.log)];
  task.active = theta_->active();
  task.thetas = theta_->size();
  task.begin = place.begin, task.end = place.end, task.rows = arc.rows();
  task.t = arc.t.data(), task.y = arc.y.data(), task.q = arc.q.data();
  task.shift = shift_;
  task.huber = huber_;
  task.x0 = trial_[k];
  return task;
}

void FlightSmoother::evaluate(const VectorXd& u, bool jacobian, bool leverage) {
  const std::vector<double> p = theta_->p(u);
  std::vector<std::vector<Seed>> seeds;
  for (int log = 0; log < record_->logs; ++log) seeds.push_back(theta_->seeds(u, log));
  std::array<double, kChannels> weight;
  for (std::size_t c = 0; c < kChannels; ++c) weight[c] = 1.0 / noise_.sigma[c];
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    RowMatrix covariance;
    for (std::size_t k = next++; k < places_.size(); k = next++) {
      ChunkTask one = task(k, u, p, seeds);
      one.weight = weight.data();
      one.jacobian = jacobian;
      if (leverage) {
        covariance = accepted_.P[k];
        one.covariance = covariance.data();
      }
      evaluate_chunk(one, results_[k]);
    }
  };
  std::vector<std::thread> crew;
  for (int i = 1; i < threads_; ++i) crew.emplace_back(work);
  work();
  for (std::thread& t : crew) t.join();
}

FlightState<double> FlightSmoother::moved(const FlightState<double>& x, const VectorXd& dx) const {
  const StateLayout& layout = record_->layout;
  FlightState<double> y = x;
  y.body.w_B += dx.segment<3>(layout.w);
  if (layout.attitude >= 0) {
    Eigen::Vector3d turn = dx.segment<3>(layout.attitude);
    const double angle = turn.norm();
    if (angle > 0.5) turn *= 0.5 / angle;  // a wild step of a first iteration
    y.body.q_WB = quaternion_product(x.body.q_WB, quaternion_from_rotation_vector(turn)).normalized();
  }
  if (layout.v >= 0) y.body.v_W += dx.segment<3>(layout.v);
  if (layout.x >= 0) y.body.x_W += dx.segment<3>(layout.x);
  for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n) {
    y.motors[static_cast<std::size_t>(n)].Omega += dx[layout.motors + n];
    y.motors[static_cast<std::size_t>(n)].Omega_dot += dx[layout.motors + layout.rotors + n];
  }
  return y;
}

// Local coordinates of the end of chunk k relative to the start of the next.
VectorXd FlightSmoother::defect(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  const FlightState<double>&a = results_[k].x_end, &b = trial_[k + 1];
  VectorXd d(layout.size);
  d.segment<3>(layout.w) = a.body.w_B - b.body.w_B;
  if (layout.attitude >= 0) {
    const Vec4<double> turn = quaternion_product(conjugate(b.body.q_WB), a.body.q_WB);
    d.segment<3>(layout.attitude) = (turn[0] < 0 ? -2.0 : 2.0) * turn.tail<3>();
  }
  if (layout.v >= 0) d.segment<3>(layout.v) = a.body.v_W - b.body.v_W;
  if (layout.x >= 0) d.segment<3>(layout.x) = a.body.x_W - b.body.x_W;
  for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n) {
    const auto m = static_cast<std::size_t>(n);
    d[layout.motors + n] = a.motors[m].Omega - b.motors[m].Omega;
    d[layout.motors + layout.rotors + n] = a.motors[m].Omega_dot - b.motors[m].Omega_dot;
  }
  return d;
}

// Inverse covariance of the defect: white acceleration over h seconds on (velocity, position) pairs,
//   q [h, h^2/2; h^2/2, h^3/3],
// plus a floor far below what the measurements of one chunk can tell, so that zero noise means continuity.
MatrixXd FlightSmoother::link_weight(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  const ChunkPlace& place = places_[k];
  const FlightArc& arc = record_->arcs[static_cast<std::size_t>(place.arc)];
  const double h = arc.t[place.end] - arc.t[place.begin], rows = static_cast<double>(place.end - place.begin);
  const auto floor = [&](int channel, double otherwise) {
    const double s = record_->sigma[static_cast<std::size_t>(channel)] < 1.0
                         ? noise_.sigma[static_cast<std::size_t>(channel)]
                         : otherwise;
    return 1e-5 * s * s / rows;
  };
  MatrixXd W = MatrixXd::Zero(layout.size, layout.size);
  const auto pair = [&](int first, int second, int c1, int c2, double q, double s1, double s2) {
    for (int i = 0; i < 3; ++i) {
      const double f1 = q * h + floor(c1 + i, s1);
      if (second < 0) {
        W(first + i, first + i) = 1.0 / f1;
        continue;
      }
      const double f2 = q * h * h * h / 3 + floor(c2 + i, s2), f12 = q * h * h / 2, det = f1 * f2 - f12 * f12;
      W(first + i, first + i) = f2 / det, W(second + i, second + i) = f1 / det;
      W(first + i, second + i) = W(second + i, first + i) = -f12 / det;
    }
  };
  pair(layout.w, layout.attitude, kGyro, kAttitude, noise_.q_w, 0.01, 0.01);
  if (layout.v >= 0) pair(layout.v, layout.x, kVelocity, kPosition, noise_.q_v, 0.01, 0.01);
  const double omega_m = theta_->p(trial_u_)[param::omega_m];
  for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n) {
    const double f = noise_.q_motor * h + floor(kRotorChannel + n, 1.0);
    W(layout.motors + n, layout.motors + n) = 1.0 / f;
    const int rate = layout.motors + layout.rotors + n;
    W(rate, rate) = 1.0 / (f * omega_m * omega_m);
  }
  return W;
}

void FlightSmoother::predict(const VectorXd& u) {
  trial_u_ = u;
  if (accepted_.f.empty()) {
    trial_ = states_;
    return;
  }
  const VectorXd du = u - u_;
  VectorXd next;
  for (std::size_t k = places_.size(); k-- > 0;) {
    VectorXd dx = -(accepted_.f[k] + accepted_.B[k] * du);
    if (places_[k].linked) dx -= accepted_.G[k] * next;
    trial_[k] = moved(states_[k], dx);
    next = dx;
  }
}

void FlightSmoother::eliminate() {
  const int n = record_->layout.size, m = theta_->size();
  Elimination& el = trial_elimination_;
  const std::size_t K = places_.size();
  el.G.resize(K), el.B.resize(K), el.f.resize(K);
  D_inverse_.resize(K);
  reduced_.cost = 0;
  reduced_.g = VectorXd::Zero(m);
  reduced_.S = MatrixXd::Zero(m, m);
  MatrixXd carry_D, carry_B;
  VectorXd carry_g;
  bool carried = false;
  for (std::size_t k = 0; k < K; ++k) {
    const ChunkResult& r = results_[k];
    const ConstRowMap A = map_A(r);
    const auto g = map_g(r);
    MatrixXd D = A.topLeftCorner(n, n);
    MatrixXd B = A.topRightCorner(n, m);
    VectorXd f = g.head(n);
    reduced_.S += A.bottomRightCorner(m, m);
    reduced_.g += g.tail(m);
    reduced_.cost += r.cost;
    if (carried) D += carry_D, B += carry_B, f += carry_g;
    MatrixXd WE, U;
    VectorXd Wd;
    if (places_[k].linked) {
      const ConstRowMap E = map_E(r, n);
      const MatrixXd W = link_weight(k);
      const VectorXd d = defect(k);
      WE = W * E;
      Wd = W * d;
      D.noalias() += E.leftCols(n).transpose() * WE.leftCols(n);
      B.noalias() += E.leftCols(n).transpose() * WE.rightCols(m);
      f.noalias() += E.leftCols(n).transpose() * Wd;
      U = -WE.leftCols(n).transpose();
      reduced_.S.noalias() += E.rightCols(m).transpose() * WE.rightCols(m);
      reduced_.g.noalias() += E.rightCols(m).transpose() * Wd;
      reduced_.cost += d.dot(Wd);
      carry_D = W;
      carry_B = -WE.rightCols(m);
      carry_g = -Wd;
    }
    // Scaled, and with a trace of damping for states that nothing measures.
    const VectorXd s = D.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    MatrixXd scaled = s.asDiagonal() * D * s.asDiagonal();
    scaled.diagonal().array() += 1e-12;
    const Eigen::LLT<MatrixXd> llt(scaled);
    MatrixXd right(n, (places_[k].linked ? n : 0) + m + 1);
    if (places_[k].linked)
      right << U, B, f;
    else
      right << B, f;
    const MatrixXd solved = s.asDiagonal() * llt.solve(s.asDiagonal() * right);
    const Index c = places_[k].linked ? n : 0;
    if (places_[k].linked) el.G[k] = solved.leftCols(n);
    el.B[k] = solved.middleCols(c, m);
    el.f[k] = solved.col(c + m);
    D_inverse_[k] = s.asDiagonal() * llt.solve(MatrixXd(s.asDiagonal()));
    reduced_.S.noalias() -= B.transpose() * el.B[k];
    reduced_.g.noalias() -= B.transpose() * el.f[k];
    reduced_.cost -= f.dot(el.f[k]);
    carried = places_[k].linked;
    if (carried) {
      carry_D.noalias() -= U.transpose() * el.G[k];
      carry_B.noalias() -= U.transpose() * el.B[k];
      carry_g.noalias() -= U.transpose() * el.f[k];
    }
  }
  reduced_.S = 0.5 * (reduced_.S + reduced_.S.transpose()).eval();
}

const ReducedSystem& FlightSmoother::linearize(const VectorXd& u) {
  predict(u);
  evaluate(u, true, false);
  eliminate();
  return reduced_;
}

void FlightSmoother::accept() {
  states_ = trial_;
  u_ = trial_u_;
  accepted_ = trial_elimination_;
}

void FlightSmoother::settle(const VectorXd& u, int rounds) {
  for (int i = 0; i < rounds; ++i) {
    linearize(u);
    accept();
  }
}

// Backward recursion for the posterior covariance of each state and of neighbours, shared unknowns held.
void FlightSmoother::posterior_covariances() {
  const std::size_t K = places_.size();
  accepted_.P.resize(K);
  accepted_.cross.resize(K);
  for (std::size_t k = K; k-- > 0;) {
    accepted_.P[k] = D_inverse_[k];
    if (!places_[k].linked) continue;
    accepted_.cross[k] = -accepted_.G[k] * accepted_.P[k + 1];
    accepted_.P[k] -= accepted_.cross[k] * accepted_.G[k].transpose();
  }
}

Moments FlightSmoother::moments() {
  settle(u_, 1);
  posterior_covariances();
  trial_ = states_;
  evaluate(u_, true, true);
  const StateLayout& layout = record_->layout;
  const int n = layout.size;
  Moments sum;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    for (std::size_t c = 0; c < kChannels; ++c) {
      sum.square[c] += results_[k].square[c];
      sum.leverage[c] += results_[k].leverage[c];
      sum.count[c] += results_[k].count[c];
    }
    if (!places_[k].linked) continue;
    const FlightArc& arc = record_->arcs[static_cast<std::size_t>(places_[k].arc)];
    const double h = arc.t[places_[k].end] - arc.t[places_[k].begin];
    const VectorXd d = defect(k);
    const MatrixXd E = map_E(results_[k], n).leftCols(n);
    const MatrixXd EC = E * accepted_.cross[k];
    const MatrixXd V = E * accepted_.P[k] * E.transpose() - EC - EC.transpose() + accepted_.P[k + 1];
    const auto add = [&](std::size_t group, int at, int count, double scale) {
      for (int i = 0; i < count; ++i) {
        sum.defect_square[group] += d[at + i] * d[at + i] / (h * scale);
        sum.defect_variance[group] += V(at + i, at + i) / (h * scale);
        sum.defect_count[group] += 1;
      }
    };
    add(0, layout.w, 3, 1.0);
    if (layout.v >= 0) add(1, layout.v, 3, 1.0);
    if (layout.motors >= 0) add(2, layout.motors, layout.rotors, 1.0);
  }
  return sum;
}

MatrixXd FlightSmoother::block_scores(double seconds, std::vector<MatrixXd>* information) {
  const int n = record_->layout.size, m = theta_->size();
  settle(u_, 1);
  trial_ = states_;
  evaluate(u_, true, false);
  // dX/du by back-substitution.
  const std::size_t K = places_.size();
  std::vector<MatrixXd> dX(K);
  for (std::size_t k = K; k-- > 0;) {
    dX[k] = -accepted_.B[k];
    if (places_[k].linked) dX[k] -= accepted_.G[k] * dX[k + 1];
  }
  std::vector<VectorXd> blocks;
  double filled = 1e300;
  int arc = -1;
  for (std::size_t k = 0; k < K; ++k) {
    const ChunkResult& r = results_[k];
    const auto g = map_g(r);
    VectorXd score = g.tail(m) + dX[k].transpose() * g.head(n);
    MatrixXd F;
    if (information) {
      MatrixXd T(n + m, m);
      T << dX[k], MatrixXd::Identity(m, m);
      F = T.transpose() * (map_A(r) * T);
    }
    if (places_[k].linked) {
      const ConstRowMap E = map_E(r, n);
      const VectorXd Wd = link_weight(k) * defect(k);
      const MatrixXd slope = E.leftCols(n) * dX[k] + E.rightCols(m) - dX[k + 1];
      score += slope.transpose() * Wd;
      if (information) F += slope.transpose() * (link_weight(k) * slope);
    }
    if (filled >= seconds || places_[k].arc != arc) {
      blocks.push_back(VectorXd::Zero(m)), filled = 0, arc = places_[k].arc;
      if (information) information->push_back(MatrixXd::Zero(m, m));
    }
    if (information) information->back() += F;
    blocks.back() += score;
    const FlightArc& a = record_->arcs[static_cast<std::size_t>(arc)];
    filled += a.t[places_[k].end] - a.t[places_[k].begin];
  }
  MatrixXd out(m, static_cast<Index>(blocks.size()));
  for (std::size_t b = 0; b < blocks.size(); ++b) out.col(static_cast<Index>(b)) = blocks[b];
  return out;
}

std::vector<FlightSmoother::End> FlightSmoother::arc_ends() {
  const int n = record_->layout.size;
  settle(u_, 1);
  trial_ = states_;
  evaluate(u_, true, false);
  std::vector<End> ends;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (places_[k].linked) continue;
    // Not linked further on: D holds all that is known of this state from the past.
    const MatrixXd E = map_E(results_[k], n).leftCols(n);
    ends.push_back({results_[k].x_end, E * D_inverse_[k] * E.transpose()});
  }
  return ends;
}

std::vector<std::vector<double>> FlightSmoother::residuals() {
  trial_ = states_;
  trial_u_ = u_;
  evaluate(u_, false, false);
  std::vector<std::vector<double>> all;
  for (const ChunkResult& r : results_) all.push_back(r.residuals);
  return all;
}

std::vector<VectorXd> FlightSmoother::defects() const {
  std::vector<VectorXd> all(places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (places_[k].linked) all[k] = defect(k);
  return all;
}

}  // namespace ident
