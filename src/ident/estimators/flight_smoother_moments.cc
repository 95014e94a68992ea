// What the last linearisation says about noise: moments of residuals, process noise, scores by block of time.
#include <algorithm>
#include <cmath>

#include "ident/estimators/dense_rows.h"
#include "ident/estimators/flight_chunk_maps.h"
#include "ident/estimators/flight_smoother.h"

namespace ident {

using chunk::rows_in;
using chunk::rows_of;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Gusts are not slower than this, s: what stays longer is a cause to be found, not noise. An estimator's
// errors are.
constexpr double kSlowest = 4.0, kSlowestShown = 30.0;
// How much denser a slow error may be than the log alone shows it: what a model misses looks like more of it.
constexpr double kMostDense = 3.0;
// The shared unknowns, which noise moves little and which make elimination twice as dear, are held for so
// many rounds; many of them, the causes of a diagnosis, make it four times as dear.
constexpr int kHeld = 4;
constexpr Index kManyShared = 40;
constexpr double kLeastMotor = 1e-9;  // (rad/s)^2/s
// Of the motors' noise more than this share of its links has to be told: what nothing tells of it would stand
// in for the noise of rates once Jp is large against Jzz.
constexpr double kNoMotorNoise = 0.03;
// A variance that links do not tell from none, (m/s^2)^2 or (rad/s^2)^2.
constexpr double kNothing = 1e-11;
// Share of the innovations that the data determine below which there might as well be none.
constexpr double kHardlyTold = 0.01;
constexpr double kStill = 0.01;  // relative change of a standard deviation that ends the rounds

// How much longer than those of expectation maximisation, which are short, the steps of a logarithm are: less
// once they lead to and fro, for sigma follows the time and the time sigma.
struct Pace {
  static constexpr double kFastest = 1.8, kLongest = 1.6;
  double factor = kFastest, last = 0.0;

  double step(double wanted) {
    if (wanted * last < 0) factor *= 0.5;
    last = wanted;
    return std::clamp(factor * wanted, -kLongest, kLongest);
  }
};

// MacKay's fixed point: what a variance is to be multiplied by, and whether that matters.
struct VarianceStep {
  double ratio;
  bool nothing;

  /// `square`: of the innovations, over their variance; `told` of `count` of them the data determine.
  VarianceStep(double square, double told, double count) {
    ratio = std::clamp(square / std::max(told, kHardlyTold * count), 0.02, 50.0);
    nothing = ratio < 1 && told < kHardlyTold * count;
  }
  double change() const { return nothing ? 0.0 : std::abs(std::sqrt(ratio) - 1); }
};

// Second moments of a Gauss-Markov process over all links: of its estimate, and of what stays unknown. Where
// the error of the input is part of a link, the link counts by the share of the process in its variance.
struct ProcessMoments {
  double now = 0, next = 0, cross = 0, seconds = 0, count = 0, links = 0;
  double square = 0, unknown = 0;  // of innovations, over the variance of their links

  /// A link of h seconds whose variance holds `error` besides the process: estimates, their variances and
  /// covariance.
  void add(const ColouredNoise& noise, double error, double x, double y, double P_x, double P_y, double C,
           double h) {
    if (noise.sigma <= 0) return;
    const double share = noise.carried(h), own = noise.sigma * noise.sigma * (1 - share * share);
    const double variance = own + error, weight = own / variance;
    const auto innovation = [&](double xx, double yy, double xy) {
      return yy - 2 * share * xy + share * share * xx;
    };
    square += weight * innovation(x * x, y * y, x * y) / variance;
    unknown += weight * innovation(P_x, P_y, C) / variance;
    now += weight * (x * x + P_x), next += weight * (y * y + P_y), cross += weight * (x * y + C);
    seconds += h, count += weight, links += 1;
  }

  /// The time by expectation maximisation, hastened by `pace`; sigma by MacKay's fixed point: squared
  /// innovations over the number of them that the data determine. Gives the relative change of sigma.
  double update(ColouredNoise& noise, Pace& pace, double slowest) const {
    if (links < 8 || noise.sigma <= 0) return 0;
    const double h = seconds / links, variance = noise.sigma * noise.sigma;
    const VarianceStep step(square, count - unknown, count);
    const double carried = std::clamp(cross / (0.5 * (now + next)), 0.01, 0.998);
    const double tau = std::clamp(-h / std::log(carried), 0.3 * h, slowest);
    noise.sigma *= std::sqrt(step.ratio);
    noise.tau = std::clamp(noise.tau * std::exp(pace.step(std::log(tau / noise.tau))), 0.3 * h, slowest);
    return variance < kNothing ? 0 : step.change();
  }
};

}  // namespace

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

double FlightSmoother::retune(int rounds, bool eliminated) {
  const StateLayout& layout = record_->layout;
  const int n = layout.size;
  double change = 0;
  VectorXd du;
  std::vector<std::array<Pace, 6>> paces(noise_.air.size());
  std::array<std::array<Pace, 3>, kShownGroups> paces_of_shown;
  for (int round = 0; round < rounds; ++round) {
    const bool many = shared() >= kManyShared;
    const bool again = many ? round == 0 || round == 3 : round % kHeld == 0 || round <= 2;
    if (round > 0) eliminate(again ? nullptr : &du);
    if (again) du = shared_optimum();
    Elimination& el = last();
    const Covariances& covariances = covariances_by(last_at_);
    const auto &P = covariances.P, &cross = covariances.cross;
    const std::vector<VectorXd> dx = state_steps(el, du);
    struct LogMoments {
      std::array<ProcessMoments, 3> turn, push;
    };
    std::vector<LogMoments> logs(noise_.air.size());
    std::array<std::array<ProcessMoments, 3>, kShownGroups> shown;
    double motors = 0, motors_determined = 0, motors_floor = 0, links = 0;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      if (!places_[k].linked) continue;
      const FlightArc& arc = record_->arcs[static_cast<std::size_t>(places_[k].arc)];
      const double h = arc.t[places_[k].end] - arc.t[places_[k].begin];
      const VectorXd now = outside(k) + dx[k], next = outside(k + 1) + dx[k + 1];
      const auto add = [&](std::array<ProcessMoments, 3>& sum, const Process& process) {
        for (int axis = 0; axis < 3 && process.at >= 0; ++axis) {
          const ColouredNoise& noise = process.axis(axis);
          const double error = new_error(k, process.input_axis(axis), noise.carried(h));
          const int i = process.at + axis;
          sum[static_cast<std::size_t>(axis)].add(noise, error, now[i], next[i], P[k](i, i), P[k + 1](i, i),
                                                  cross[k](i, i), h);
        }
      };
      LogMoments& log = logs[static_cast<std::size_t>(arc.log)];
      const auto all = processes(k);
      add(log.turn, all[0]), add(log.push, all[1]);
      for (std::size_t g = 0; g < kShownGroups; ++g) add(shown[g], all[2 + g]);
      if (layout.motors < 0 || noise_.q_motor <= 0) continue;
      const auto E = chunk::E(results_[k], n);
      const VectorXd d = defect(k), W = link_weight(k);
      for (int r = layout.motors; r < layout.motors + layout.rotors; ++r) {
        const VectorXd e = E.row(r).head(n).transpose();
        const double left = d[r] + e.dot(dx[k]) + E.row(r).tail(theta_->size()).dot(du) - dx[k + 1][r];
        const double V = e.dot(P[k].leftCols(n) * e) - 2 * cross[k].row(r).head(n).dot(e) + P[k + 1](r, r);
        motors += W[r] * left * left, motors_determined += 1 - W[r] * V, links += 1;
        motors_floor += 1 / (W[r] * h) - noise_.q_motor;
      }
    }
    change = 0;
    for (std::size_t log = 0; log < logs.size(); ++log)
      for (std::size_t i = 0; i < 3; ++i)
        change =
            std::max({change, logs[log].turn[i].update(noise_.air[log].w_dot[i], paces[log][i], kSlowest),
                      logs[log].push[i].update(noise_.air[log].v_dot[i], paces[log][3 + i], kSlowest)});
    for (std::size_t g = 0; g < kShownGroups; ++g)
      for (std::size_t i = 0; i < 3 && layout.shown_error[g] >= 0; ++i) {
        ColouredNoise& error = noise_.slow[g][i];
        change = std::max(change, shown[g][i].update(error, paces_of_shown[g][i], kSlowestShown));
        const ColouredNoise& seen = record_->slow[g][i];
        error.sigma = std::min(error.sigma, seen.sigma * std::sqrt(kMostDense * error.tau / seen.tau));
      }
    if (links > 0) {  // MacKay's fixed point here too: it reaches zero where there is no such noise
      const VarianceStep step(motors, motors_determined + kNoMotorNoise * links, links);
      // It is the variance of the links, of which the floor is a part, that is to shrink by that ratio.
      const double of_floor = std::min(step.ratio - 1, 0.0) * motors_floor / links;
      noise_.q_motor = std::max(noise_.q_motor * step.ratio + of_floor, kLeastMotor);
      if (noise_.q_motor > kLeastMotor) change = std::max(change, step.change());
    }
    if (change < kStill) break;
  }
  if (eliminated)
    eliminate();
  else
    eliminated_ = false;
  return change;
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
      // Rows are about the state, which follows dX, and theta; profiles act through links only.
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
        if (m > own) slope.middleCols(own, m - own) -= profile(k);
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
