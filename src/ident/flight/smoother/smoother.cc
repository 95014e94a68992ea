// Evaluates the chunks in parallel, predicts their states and moves them to their optimum.
#include "ident/flight/smoother/smoother.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "ident/core/parallel.h"
#include "ident/core/stage_times.h"
#include "ident/effects/all_parameters.h"
#include "ident/flight/smoother/chunk_maps.h"

namespace ident {

using Eigen::VectorXd;

namespace {

// Delay of rates and attitude about which the model is linearised: as far as the rows reach that a chunk sees
// beyond its end.
double sensor_delay_of(const std::vector<double>& p, double interval) {
  static const int tau = find_parameter("sensor_delay.tau")->index;
  constexpr double kRows = 50.0;
  return std::clamp(p[static_cast<std::size_t>(tau)], 0.0, kRows * interval);
}

// Shares of a state's step that are tried in turn where the simulation diverges with all of it. A nearly
// instant motor, say, leaves so little trace of its state at the start of an arc that first steps there are
// wild.
constexpr std::array kShares = {0.1, 0.0};

// Rounds without a lower cost after which none is expected: residuals at the bend of the robust cost promise
// a decrease at every step to and fro.
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
      states_.push_back(arc.start(begin));
      begin = end;
    }
    if (places_.size() > first) chains_.push_back(chain_of(first, places_.size()));
  }
  results_.resize(places_.size());
  set_axes();
  u_ = trial_u_ = VectorXd::Zero(theta.size());
}

void FlightSmoother::set_noise(const NoiseModel& noise) {
  const bool turn = noise.axes != noise_.axes;
  if (turn || noise.sigma != noise_.sigma) stands_ = false;
  noise_ = noise;
  eliminated_ = false;
  if (!turn) return;
  set_axes();
  accepted() = {};  // steps along other axes
  if (covariances_.of == accepted_at_) covariances_.of.reset();
}

void FlightSmoother::unlink() {
  for (ChunkPlace& place : places_) place.linked = false;
  chains_.clear();
  for (std::size_t k = 0; k < places_.size(); ++k) chains_.push_back(chain_of(k, k + 1));
  eliminated_ = linearised_.stands = false;
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
  const Stage stage("chunks simulated");
  const std::vector<double> p = theta_->p(u);
  std::vector<std::vector<Seed>> seeds;
  seeds.reserve(static_cast<std::size_t>(record_->logs));
  for (int log = 0; log < record_->logs; ++log) seeds.push_back(theta_->seeds(u, log));
  std::array<double, kChannels> weight;
  for (std::size_t c = 0; c < kChannels; ++c) weight[c] = 1.0 / noise_.sigma[c];
  linearised_.stands = linearised_.stands && !jacobian;
  in_parallel(chunks.size(), [&](std::size_t i) {
    const std::size_t k = chunks[i];
    ChunkTask one = task(k, u, p, seeds);
    one.weight = weight.data();
    one.jacobian = jacobian;
    one.steps = by_, one.exact = exact_, one.few_leverages = true;
    chunk::RowMatrix covariance;
    if (leverage) {
      covariance = covariances_.P[k].leftCols(record_->layout.size);
      one.covariance = covariance.data();
    }
    evaluate_chunk(one, results_[k]);
  });
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

// Shortens the steps of those states from which the simulation diverges.
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
  if (leverage) covariances_by(accepted_at_);
  predict(u);
  evaluate(u, true, leverage);
  if (gentle_) shorten_wild_steps(u, leverage);
  eliminate();
  stands_ = true, leverages_ = leverage;
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
  settle_until(u, rounds, enough, [](double fall, double) { return fall; });
}

void FlightSmoother::settle_ends(const VectorXd& u, int rounds, double enough) {
  settle_until(u, rounds, enough, [](double fall, double before) {
    // Sum of further decreases that shrink as the last one did.
    const double shrinks = fall / before;
    return shrinks < 1 ? fall * shrinks / (1 - shrinks) : fall;
  });
}

// Goes on until what is `left` to gain, by the decrease of the last two rounds, is small.
void FlightSmoother::settle_until(const VectorXd& u, int rounds, double enough,
                                  const std::function<double(double fall, double before)>& left) {
  double least = std::numeric_limits<double>::infinity(), before = 0;
  int in_vain = 0;  // rounds one after the other
  for (int i = 0; i < rounds && in_vain < kInVain; ++i) {
    const ReducedSystem& system = linearize(u);
    accept();
    if (left(system.fall, before) < enough * system.cost) return;
    before = system.fall;
    in_vain = system.cost < (1 - enough) * least ? 0 : in_vain + 1;
    least = std::min(least, system.cost);
  }
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

std::vector<VectorXd> FlightSmoother::defects() const {
  std::vector<VectorXd> all(places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (places_[k].linked) all[k] = defect(k);
  return all;
}

}  // namespace ident
