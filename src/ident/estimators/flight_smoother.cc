// Parallel evaluation of the chain of chunks, and its states.
#include "ident/estimators/flight_smoother.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "ident/core/parallel.h"
#include "ident/estimators/flight_chunk_maps.h"

namespace ident {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The delay of rates and attitude is simulated, not linearised, up to the rows that a chunk sees beyond its
// end.
double sensor_delay_of(const std::vector<double>& p, double interval) {
  static const int tau = find_parameter("sensor_delay.tau")->index;
  constexpr double kRows = 50.0;
  return std::clamp(p[static_cast<std::size_t>(tau)], 0.0, kRows * interval);
}

// What is tried of a state's step, one after the other, where with all of it nothing flies: a nearly instant
// motor, say, leaves so little of its state at the start of an arc that the first steps there are wild.
constexpr std::array kShares = {0.1, 0.0};

// Rounds without a lower cost after which none will come: residuals that are bent where they are gross
// promise a fall at every step to and fro.
constexpr int kInVain = 3;

bool flies(const ChunkResult& result) {
  if (!std::isfinite(result.cost) || !result.x_end.body.w_B.allFinite()) return false;
  return std::ranges::all_of(result.E, [](double e) { return std::isfinite(e); }) &&
         std::ranges::all_of(result.A, [](double a) { return std::isfinite(a); });
}

}  // namespace

FlightSmoother::FlightSmoother(const FlightRecord& record, const Theta& theta, NoiseModel noise,
                               double chunk_seconds, int threads)
    : record_(&record),
      theta_(&theta),
      noise_(std::move(noise)),
      chunk_seconds_(chunk_seconds),
      threads_(threads) {
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    const std::size_t first = places_.size();
    unseen_.push_back(unseen_in(arc));
    std::size_t begin = 0;
    while (begin + 1 < arc.rows()) {
      std::size_t end = begin + 1;
      while (end + 1 < arc.rows() && arc.t[end] - arc.t[begin] < chunk_seconds - 1e-9) ++end;
      if (arc.rows() - 1 - end < (end - begin) / 2) end = arc.rows() - 1;  // no tiny rest
      places_.push_back({static_cast<int>(a), begin, end, end + 1 < arc.rows()});
      states_.push_back(arc.start[begin]);
      begin = end;
    }
    if (places_.size() > first) chains_.push_back(chain_of(first, places_.size()));
  }
  results_.resize(places_.size());
  set_axes();
  u_ = trial_u_ = VectorXd::Zero(theta.size());
}

void FlightSmoother::start_from(const FlightSmoother& other) {
  const std::vector<double> p = other.theta_->p(other.u_);
  const std::vector<std::vector<Seed>> none(static_cast<std::size_t>(record_->logs));
  std::array<double, kChannels> weight;
  for (std::size_t c = 0; c < kChannels; ++c) weight[c] = 1.0 / other.noise_.sigma[c];
  std::vector<std::size_t> from(places_.size());  // the chunk of the other one in which each begins
  for (std::size_t k = 0, at = 0; k < places_.size(); ++k) {
    while (other.places_[at].arc != places_[k].arc || other.places_[at].end <= places_[k].begin) ++at;
    from[k] = at;
  }
  in_parallel(places_.size(), [&](std::size_t k) {
    states_[k] = other.states_[from[k]];
    if (other.places_[from[k]].begin == places_[k].begin) return;
    ChunkTask one = other.task(from[k], other.u_, p, none);
    one.x0 = states_[k], one.end = places_[k].begin, one.steps = other.by_;
    one.weight = weight.data(), one.jacobian = false;
    ChunkResult result;
    evaluate_chunk(one, result);
    const bool flew = result.x_end.body.w_B.allFinite() && result.x_end.body.v_W.allFinite();
    states_[k] =
        flew ? result.x_end : record_->arcs[static_cast<std::size_t>(places_[k].arc)].start[places_[k].begin];
  });
  set_axes();
}

void FlightSmoother::set_noise(const NoiseModel& noise) {
  const bool turn = noise.axes != noise_.axes;
  if (turn || noise.sigma != noise_.sigma) stands_ = false;
  noise_ = noise;
  eliminated_ = false;
  if (!turn) return;
  set_axes();
  accepted() = {};  // steps along other axes
}

// The accelerations of all states along the axes of the noise.
void FlightSmoother::set_axes() {
  for (FlightState<double>& x : states_) {
    if (x.outside.axes == noise_.axes) continue;
    const Eigen::Matrix3d R_WB = rotation(x.body.q_WB);
    const bool turns = noise_.axes == GustAxes::body;
    x.outside.v_dot = (turns ? Eigen::Matrix3d(R_WB.transpose()) : R_WB) * x.outside.v_dot;
    x.outside.axes = noise_.axes;
  }
  trial_ = states_;
  set_input_errors();
}

void FlightSmoother::unlink() {
  for (ChunkPlace& place : places_) place.linked = false;
  chains_.clear();
  for (std::size_t k = 0; k < places_.size(); ++k) chains_.push_back(chain_of(k, k + 1));
  eliminated_ = false;
}

void FlightSmoother::in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) const {
  ident::in_parallel(count, work, threads_);
}

ChunkTask FlightSmoother::task(std::size_t k, const VectorXd& u, const std::vector<double>& p,
                               const std::vector<std::vector<Seed>>& seeds) const {
  const ChunkPlace& place = places_[k];
  const FlightArc& arc = record_->arcs[static_cast<std::size_t>(place.arc)];
  ChunkTask task;
  task.vehicle = record_->vehicle;
  task.inputs = arc.inputs.get();
  task.layout = record_->layout;
  task.p = p;
  task.gyro_bias = theta_->gyro_bias(u, arc.log);
  task.seeds = seeds[static_cast<std::size_t>(arc.log)];
  task.active = active_effects(p);
  task.thetas = theta_->size();
  task.begin = place.begin, task.end = place.end, task.rows = arc.rows();
  task.t = arc.t.data(), task.y = arc.y.data(), task.q = arc.q.data();
  task.shift = sensor_delay_of(p, record_->interval);
  task.huber = huber_;
  task.x0 = trial_[k];
  return task;
}

void FlightSmoother::evaluate(const VectorXd& u, bool jacobian, bool leverage) {
  std::vector<std::size_t> all(places_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  evaluate(u, jacobian, leverage, all);
}

void FlightSmoother::evaluate(const VectorXd& u, bool jacobian, bool leverage,
                              const std::vector<std::size_t>& chunks) {
  const std::vector<double> p = theta_->p(u);
  std::vector<std::vector<Seed>> seeds;
  seeds.reserve(static_cast<std::size_t>(record_->logs));
  for (int log = 0; log < record_->logs; ++log) seeds.push_back(theta_->seeds(u, log));
  std::array<double, kChannels> weight;
  for (std::size_t c = 0; c < kChannels; ++c) weight[c] = 1.0 / noise_.sigma[c];
  in_parallel(chunks.size(), [&](std::size_t i) {
    const std::size_t k = chunks[i];
    ChunkTask one = task(k, u, p, seeds);
    one.weight = weight.data();
    one.jacobian = jacobian;
    one.steps = by_, one.exact = exact_, one.few_leverages = true;
    chunk::RowMatrix covariance;
    if (leverage) {
      covariance = accepted().P[k].leftCols(record_->layout.size);
      one.covariance = covariance.data();
    }
    evaluate_chunk(one, results_[k]);
  });
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
  if (layout.w_dot >= 0) y.outside.w_dot_B += dx.segment<3>(layout.w_dot);
  if (layout.v_dot >= 0) y.outside.v_dot += dx.segment<3>(layout.v_dot);
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
  const VectorXd share = carried(k);
  const auto carries = [&](int at, const Vec3<double>& before, const Vec3<double>& after) {
    if (at >= 0) d.segment<3>(at) = share.segment<3>(at).cwiseProduct(before) - after;
  };
  carries(layout.w_dot, a.outside.w_dot_B, b.outside.w_dot_B);
  carries(layout.v_dot, a.outside.v_dot, b.outside.v_dot);
  for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n) {
    const auto m = static_cast<std::size_t>(n);
    d[layout.motors + n] = a.motors[m].Omega - b.motors[m].Omega;
    d[layout.motors + layout.rotors + n] = a.motors[m].Omega_dot - b.motors[m].Omega_dot;
  }
  return d;
}

void FlightSmoother::predict(const VectorXd& u) {
  trial_u_ = u;
  steps_.clear();
  if (accepted().f.empty()) {
    trial_ = states_;
    return;
  }
  steps_ = state_steps(accepted(), u - u_);
  for (std::size_t k = 0; k < places_.size(); ++k) trial_[k] = moved(states_[k], steps_[k]);
}

// The same with shorter steps of those states from which nothing flies.
void FlightSmoother::shorten_wild_steps(const VectorXd& u, bool leverage) {
  if (steps_.empty()) return;
  for (const double share : kShares) {
    std::vector<std::size_t> wild;
    for (std::size_t k = 0; k < places_.size(); ++k)
      if (!flies(results_[k])) wild.push_back(k);
    if (wild.empty()) return;
    for (const std::size_t k : wild) trial_[k] = moved(states_[k], share * steps_[k]);
    evaluate(u, true, leverage, wild);
  }
}

const ReducedSystem& FlightSmoother::linearize(const VectorXd& u, bool leverage) {
  if (leverage) posterior_covariances(accepted());
  predict(u);
  evaluate(u, true, leverage);
  if (gentle_) shorten_wild_steps(u, leverage);
  eliminate();
  stands_ = true;
  return reduced_;
}

const ReducedSystem& FlightSmoother::relinearize() {
  if (!eliminated_) eliminate();
  return reduced_;
}

void FlightSmoother::accept() {
  states_ = trial_;
  u_ = trial_u_;
  accepted_at_ = last_at_;
}

void FlightSmoother::settle(const VectorXd& u, int rounds, double enough) {
  double least = std::numeric_limits<double>::infinity();
  int in_vain = 0;  // rounds one after the other
  for (int i = 0; i < rounds && in_vain < kInVain; ++i) {
    const ReducedSystem& system = linearize(u);
    accept();
    if (system.fall < enough * system.cost) return;
    in_vain = system.cost < (1 - enough) * least ? 0 : in_vain + 1;
    least = std::min(least, system.cost);
  }
}

std::vector<FlightSmoother::End> FlightSmoother::arc_ends() {
  const int n = record_->layout.size;
  const std::vector<VectorXd> dx = state_steps(accepted(), VectorXd::Zero(theta_->size()));
  std::vector<End> ends;
  for (const Chain& chain : chains_) {
    const std::size_t last = chain.end - 1;
    if (chain.meet != last) posterior_covariances(accepted());
    const MatrixXd P = chain.meet == last ? own_covariance(accepted(), last) : accepted().P[last];
    const MatrixXd E = chunk::E(results_[last], n).leftCols(n);
    ends.push_back({moved(results_[last].x_end, E * dx[last]), E * P.leftCols(n) * E.transpose()});
  }
  return ends;
}

std::vector<std::vector<double>> FlightSmoother::residuals() {
  stands_ = stands_ && trial_u_ == u_;
  trial_ = states_;
  trial_u_ = u_;
  evaluate(u_, false, false);
  std::vector<std::vector<double>> all;
  for (const ChunkResult& r : results_) all.push_back(r.residuals);
  return all;
}

double FlightSmoother::worth_of_fine_steps() {
  const Steps present = by_;
  std::array<std::vector<std::vector<double>>, 2> by;
  for (std::size_t i = 0; i < 2; ++i) {
    by_ = i == 0 ? Steps::fine : present;
    by[i] = residuals();
  }
  double sum = 0;
  for (std::size_t k = 0; k < by[0].size(); ++k)
    for (std::size_t i = 0; i < by[0][k].size(); ++i)
      if (const double d = by[0][k][i] - by[1][k][i]; std::isfinite(d)) sum += d * d;
  return sum;
}

std::vector<VectorXd> FlightSmoother::defects() const {
  std::vector<VectorXd> all(places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (places_[k].linked) all[k] = defect(k);
  return all;
}

}  // namespace ident
