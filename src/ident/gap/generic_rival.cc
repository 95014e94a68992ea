// Features of the flight as profiles of acceleration from outside, and their gain on blocks left out.
#include "ident/gap/generic_rival.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kChunk = 0.2;  // s: features are slow
constexpr int kFolds = 6;
// Coefficients that are expected, in standard deviations of the noise a unit of a feature: the best is taken.
constexpr std::array kSizes = {1.0, 0.3, 0.1};
constexpr double kGross = 6.0;  // residuals of a sensor count up to this

double at(const std::vector<double>& column, std::size_t i) { return column.empty() ? 1.0 : column[i]; }

// One row for each chunk: what the flight shows there, and two velocities and rates before.
MatrixXd features(const FlightRecord& record, const FlightSmoother& smoother, double hover) {
  const auto& places = smoother.chunks();
  const auto& states = smoother.states();
  const auto N = static_cast<std::size_t>(record.layout.rotors);
  std::vector<VectorXd> rows;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(places[k].arc)];
    const FlightState<double>& x = states[k];
    const Mat3<double> R = rotation(x.body.q_WB);
    const Eigen::Vector3d v = R.transpose() * x.body.v_W, w = x.body.w_B;
    std::vector<double> f;
    for (int c = 0; c < 3; ++c)
      f.insert(f.end(), {v[c], v[c] * v.norm(), w[c], R(2, c), w[c] * w[(c + 1) % 3]});
    f.insert(f.end(), {v.head<2>().squaredNorm(), R(0, 0), R(1, 0)});
    double thrust = 0;
    for (std::size_t n = 0; n < N; ++n) {
      const double ratio = x.motors[n].Omega / hover;
      thrust += ratio * ratio / static_cast<double>(N);
      f.insert(f.end(), {ratio * ratio, x.motors[n].Omega_dot / hover});
    }
    const double z = std::max(record.vehicle->ground_z - x.body.x_W[2], 0.0);
    f.insert(f.end(), {thrust * thrust, thrust / (0.05 + z * z),
                       at(arc.inputs->voltage_ratio, places[k].begin) * thrust,
                       (arc.t[places[k].begin] - arc.inputs->t0) * thrust});
    // Memory: a swinging load, air that has to be set in motion.
    for (const std::size_t back : {1UL, 3UL}) {
      const bool there = k >= back && places[k - back].arc == places[k].arc;
      const FlightState<double>& y = there ? states[k - back] : x;
      for (int c = 0; c < 3; ++c) f.insert(f.end(), {y.body.v_W[c] - x.body.v_W[c], y.body.w_B[c] - w[c]});
    }
    rows.push_back(Eigen::Map<VectorXd>(f.data(), static_cast<Index>(f.size())));
  }
  MatrixXd X(static_cast<Index>(rows.size()), rows.empty() ? 0 : rows[0].size());
  for (std::size_t k = 0; k < rows.size(); ++k) X.row(static_cast<Index>(k)) = rows[k];
  for (Index c = 0; c < X.cols(); ++c) {
    X.col(c).array() -= X.col(c).mean();
    const double s = std::sqrt(X.col(c).squaredNorm() / static_cast<double>(X.rows()));
    X.col(c) *= s > 1e-9 ? 1.0 / s : 0.0;
  }
  return X;
}

// What is gained on parts of the flight that were left out, over the spread of what is missed there in units
// of white noise: coloured residuals promise more than they hold.
class HeldOutGain {
 public:
  /// A part: fall of the cost there, what the prediction misses along itself, and the variance that white
  /// noise gives that.
  void add(double fall, double missed, double variance) {
    gain_ += fall;
    if (variance > 0) spread_ += missed * missed / variance, parts_ += 1;
  }
  double honest() const { return gain_ / (parts_ > 0 ? std::max(spread_ / parts_, 1.0) : 1.0); }

 private:
  double gain_ = 0, spread_ = 0, parts_ = 0;
};

// Fall of the cost on the blocks of each fold, of unknowns fitted to the others, coefficients of about
// `size`; beyond that of theta alone.
double held_out_gain(const std::vector<ScoreBlock>& blocks, const PriorTerms& prior, double expected) {
  const Index m = blocks[0].score.size(), own = prior.slope.size();
  VectorXd info = VectorXd::Constant(m, 1 / (expected * expected)), pull = VectorXd::Zero(m);
  info.head(own) = prior.slope.cwiseAbs2().cwiseMax(1e-2);
  pull.head(own) = prior.slope.cwiseProduct(prior.residual);
  const auto solved = [&](const MatrixXd& F, const VectorXd& g, Index size) {
    MatrixXd H = F.topLeftCorner(size, size);
    H.diagonal() += info.head(size);
    return VectorXd(-Eigen::LDLT<MatrixXd>(H).solve(g.head(size) + pull.head(size)));
  };
  const auto fall = [](const ScoreBlock& block, const VectorXd& x) {
    const Index n = x.size();
    return -2 * block.score.head(n).dot(x) - x.dot(block.information.topLeftCorner(n, n) * x);
  };
  HeldOutGain gain;
  for (int fold = 0; fold < kFolds; ++fold) {
    const auto left_out = [&](std::size_t b) { return static_cast<int>(b / 2) % kFolds == fold; };
    MatrixXd F = MatrixXd::Zero(m, m);
    VectorXd g = VectorXd::Zero(m);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      if (!left_out(b)) F += blocks[b].information, g += blocks[b].score;
    const VectorXd all = solved(F, g, m), plain = solved(F, g, own);
    VectorXd further = all;  // what the features say beyond theta
    further.head(own) -= plain;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (!left_out(b)) continue;
      const VectorXd known = blocks[b].information * further;
      const double missed = further.dot(blocks[b].score + blocks[b].information * all);
      gain.add(fall(blocks[b], all) - fall(blocks[b], plain), missed, further.dot(known));
    }
  }
  return gain.honest();
}

// The same for what a sensor shows beyond the model: weighted residuals of a channel, and how many, by chunk.
struct SensorResiduals {
  VectorXd sum, count;
};
SensorResiduals residuals_of(const std::vector<std::vector<double>>& residuals, std::size_t channel) {
  const auto chunks = static_cast<Index>(residuals.size());
  SensorResiduals out{VectorXd::Zero(chunks), VectorXd::Zero(chunks)};
  for (Index k = 0; k < chunks; ++k) {
    const std::vector<double>& of = residuals[static_cast<std::size_t>(k)];
    for (std::size_t i = channel; i < of.size(); i += kChannels)
      if (std::isfinite(of[i])) out.sum[k] += std::clamp(of[i], -kGross, kGross), out.count[k] += 1;
  }
  return out;
}

// Fall of the cost on the chunks of each fold, of a regression on X fitted to the others; `parts` numbers
// stretches of some seconds.
double held_out_gain(const SensorResiduals& r, const MatrixXd& X, const std::vector<int>& parts,
                     double expected) {
  HeldOutGain gain;
  for (int fold = 0; fold < kFolds; ++fold) {
    VectorXd fitted_count = r.count, left_count = r.count;
    VectorXd fitted_sum = r.sum;
    for (Index k = 0; k < X.rows(); ++k) {
      const bool left_out = parts[static_cast<std::size_t>(k)] % kFolds == fold;
      (left_out ? fitted_count : left_count)[k] = 0;
      if (left_out) fitted_sum[k] = 0;
    }
    MatrixXd H = X.transpose() * fitted_count.asDiagonal() * X;
    H.diagonal().array() += 1 / (expected * expected);
    const VectorXd predicted = X * Eigen::LDLT<MatrixXd>(H).solve(X.transpose() * fitted_sum);
    double fall = 0, missed = 0, variance = 0;
    for (Index k = 0; k < X.rows(); ++k) {
      const double count = left_count[k], x = predicted[k];
      fall += count > 0 ? x * (2 * r.sum[k] - count * x) : 0.0;
      missed += count > 0 ? x * (r.sum[k] - count * x) : 0.0;
      variance += count * x * x;
      const auto part = [&](Index i) { return parts[static_cast<std::size_t>(i)]; };
      if (k + 1 < X.rows() && part(k + 1) == part(k)) continue;
      gain.add(fall, missed, variance);
      fall = missed = variance = 0;
    }
  }
  return gain.honest();
}

// What the sensors show beyond the model, channel by channel; a constant is one of the features.
void add_sensors(Rival& rival, const FlightRecord& record, FlightSmoother& smoother, const MatrixXd& X) {
  MatrixXd with_constant(X.rows(), X.cols() + 1);
  with_constant << X, VectorXd::Ones(X.rows());
  std::vector<int> parts;
  for (const ChunkPlace& place : smoother.chunks()) {
    const double t = record.arcs[static_cast<std::size_t>(place.arc)].t[place.begin];
    parts.push_back(static_cast<int>(std::abs(t) / 4.0) + 1000 * place.arc);
  }
  const auto residuals = smoother.residuals();
  for (int channel = 0; channel < kRotorChannel + record.layout.rotors; ++channel) {
    const SensorResiduals r = residuals_of(residuals, static_cast<std::size_t>(channel));
    if (r.count.sum() < 1000) continue;
    double best = -1e300;
    for (const double size : kSizes)
      best = std::max(best, held_out_gain(r, with_constant, parts, 0.3 * size));
    rival.sensors.emplace_back(channel_name(channel), best);
  }
}

}  // namespace

double Rival::total() const {
  double sum = 0;
  for (const double x : gain) sum += std::max(x, 0.0);
  for (const auto& [channel, x] : sensors) sum += std::max(x, 0.0);
  return sum;
}

std::string Rival::strongest() const {
  static constexpr std::array wrench = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  const auto most = std::ranges::max_element(gain);
  std::string name = wrench[static_cast<std::size_t>(most - gain.begin())];
  double best = *most;
  for (const auto& [channel, x] : sensors)
    if (x > best) best = x, name = channel;
  return name;
}

Rival generic_rival(const FlightRecord& record, const Theta& theta, const FlightFit& fit,
                    const NoiseModel& floor) {
  Rival rival;
  FlightSmoother smoother(record, theta, floor, std::max(fit.chunk_seconds, kChunk));
  if (smoother.chunks().size() < 60) return rival;
  smoother.settle(fit.u, 2);
  smoother.linearize(fit.u);
  smoother.accept();
  const std::vector<double> p = theta.p(fit.u);
  const double hover =
      std::sqrt(p[param::m] * record.vehicle->g / (static_cast<double>(record.layout.rotors) * p[param::kT]));
  const MatrixXd X = features(record, smoother, hover);
  add_sensors(rival, record, smoother, X);
  const PriorTerms prior = theta.prior(fit.u);
  double push = 0;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (const AirNoise& air : floor.air)
    for (std::size_t k = 0; k < 3; ++k) {
      push += air.v_dot[k].sigma / (3 * static_cast<double>(floor.air.size()));
      turn[static_cast<Index>(k)] += air.w_dot[k].sigma / static_cast<double>(floor.air.size());
    }
  for (int channel = 0; channel < 6; ++channel) {
    const bool force = channel < 3;
    if (force ? record.layout.v_dot < 0 : record.layout.w_dot < 0) continue;
    std::vector<MatrixXd> profiles;
    for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
      Eigen::Matrix<double, 6, 1> direction = Eigen::Matrix<double, 6, 1>::Zero();
      if (force)
        direction.tail<3>() = push * rotation(smoother.states()[k].body.q_WB).col(channel);
      else
        direction[channel - 3] = turn[channel - 3];
      profiles.emplace_back(direction * X.row(static_cast<Index>(k)));
    }
    smoother.set_profiles(std::move(profiles));
    smoother.relinearize();
    smoother.accept();
    const std::vector<ScoreBlock> blocks = smoother.score_blocks(2.0);
    double& gain = rival.gain[static_cast<std::size_t>(channel)];
    gain = -1e300;
    for (const double size : kSizes) gain = std::max(gain, held_out_gain(blocks, prior, size));
    if (gain == -1e300) gain = 0;  // nothing that can be judged
  }
  return rival;
}

}  // namespace ident
