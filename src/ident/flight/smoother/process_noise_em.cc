// Maximum likelihood estimate of the process noise at the last linearisation: gusts, slow errors, motors.
#include <algorithm>
#include <cmath>

#include "ident/core/stage_times.h"
#include "ident/flight/smoother/chunk_maps.h"
#include "ident/flight/smoother/smoother.h"

namespace ident {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Longest correlation times, s, of gusts and of the slow errors of an estimator. What lasts longer than a
// gust is a cause to be found.
constexpr double kSlowest = 4.0, kSlowestShown = 30.0;
// Largest density of a slow error over what the log alone shows: what a model misses looks like more of it.
constexpr double kMostDense = 3.0;
// Rounds in which the shared unknowns are held: the noise moves them little, and they double the cost of
// elimination. Above kManyShared of them, as in a diagnosis, they quadruple it.
constexpr int kHeld = 4;
constexpr Index kManyShared = 40;
constexpr double kLeastMotor = 1e-9;  // (rad/s)^2/s
// Share of the links of motors that is added to those that the data determine. Noise below it is none: it
// would otherwise stand in for the noise of the rates where Jp is large against Jzz.
constexpr double kNoMotorNoise = 0.03;
// A variance that links cannot tell from zero, (m/s^2)^2 or (rad/s^2)^2.
constexpr double kNothing = 1e-11;
// Where the data determine less than this share of the innovations there may be no such noise.
constexpr double kHardlyTold = 0.01;
constexpr double kStill = 0.01;  // relative change of a standard deviation that ends the rounds

// Lengthens the steps of a logarithm, which are short in expectation maximisation. The factor is halved once
// steps alternate, for sigma follows tau and tau sigma.
struct Pace {
  static constexpr double kFastest = 1.8, kLongest = 1.6;
  double factor = kFastest, last = 0.0;

  double step(double wanted) {
    if (wanted * last < 0) factor *= 0.5;
    last = wanted;
    return std::clamp(factor * wanted, -kLongest, kLongest);
  }
};

// MacKay's fixed point [MacKay 1992]: the factor on a variance, and whether the variance matters at all.
struct VarianceStep {
  double ratio;
  bool nothing;

  /// `square`: squared innovations over their variance. `told`: how many of the `count` innovations the data
  /// determine.
  VarianceStep(double square, double told, double count) {
    ratio = std::clamp(square / std::max(told, kHardlyTold * count), 0.02, 50.0);
    nothing = ratio < 1 && told < kHardlyTold * count;
  }
  double change() const { return nothing ? 0.0 : std::abs(std::sqrt(ratio) - 1); }
};

// Second moments of a Gauss-Markov process over all links, of its estimate and of what stays unknown. Where
// the error of the input shares a link, the link counts by the share of the process in its variance.
struct ProcessMoments {
  double now = 0, next = 0, cross = 0, seconds = 0, count = 0, links = 0;
  double square = 0, unknown = 0;  // of innovations, over the variance of their links

  /// Adds a link of h seconds whose variance holds `error` besides the process: the two estimates, their
  /// variances and their covariance.
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

  /// Updates tau by expectation maximisation, lengthened by `pace`, and sigma by MacKay's fixed point.
  /// Returns the relative change of sigma.
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

// The same for the noise of the motors, whose variance may be zero.
struct MotorMoments {
  double square = 0, told = 0, floor = 0, links = 0;

  /// Adds a link of h seconds with weight W: `left` is its smoothed defect, V the variance that the data
  /// leave unknown.
  void add(double left, double W, double V, double h, double q_motor) {
    square += W * left * left, told += 1 - W * V, links += 1;
    floor += 1 / (W * h) - q_motor;
  }

  /// Returns the relative change of the standard deviation.
  double update(double& q_motor) const {
    if (links == 0) return 0;
    const VarianceStep step(square, told + kNoMotorNoise * links, links);
    // The ratio holds for the variance of the links, of which the floor is a part.
    const double of_floor = std::min(step.ratio - 1, 0.0) * floor / links;
    q_motor = std::max(q_motor * step.ratio + of_floor, kLeastMotor);
    return q_motor > kLeastMotor ? step.change() : 0;
  }
};

}  // namespace

struct FlightSmoother::LinkMoments {
  struct Log {
    std::array<ProcessMoments, 3> turn, push;
  };
  std::vector<Log> logs;
  std::array<std::array<ProcessMoments, 3>, kShownGroups> shown;
  MotorMoments motors;
};

struct FlightSmoother::NoisePaces {
  std::vector<std::array<Pace, 6>> logs;
  std::array<std::array<Pace, 3>, kShownGroups> shown;
};

FlightSmoother::LinkMoments FlightSmoother::link_moments(const VectorXd& du) {
  const StateLayout& layout = record_->layout;
  const int n = layout.size;
  const Covariances& covariances = covariances_by(last_at_);
  const auto &P = covariances.P, &cross = covariances.cross;
  const std::vector<VectorXd> dx = state_steps(last(), du);
  LinkMoments sum{.logs = std::vector<LinkMoments::Log>(noise_.air.size())};
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (!places_[k].linked) continue;
    const FlightArc& arc = record_->arcs[static_cast<std::size_t>(places_[k].arc)];
    const double h = arc.t[places_[k].end] - arc.t[places_[k].begin];
    const VectorXd now = outside(k) + dx[k], next = outside(k + 1) + dx[k + 1];
    const auto add = [&](std::array<ProcessMoments, 3>& moments, const Process& process) {
      for (int axis = 0; axis < 3 && process.at >= 0; ++axis) {
        const ColouredNoise& noise = process.axis(axis);
        const double error = new_error(k, process.input_axis(axis), noise.carried(h));
        const int i = process.at + axis;
        moments[static_cast<std::size_t>(axis)].add(noise, error, now[i], next[i], P[k](i, i), P[k + 1](i, i),
                                                    cross[k](i, i), h);
      }
    };
    LinkMoments::Log& log = sum.logs[static_cast<std::size_t>(arc.log)];
    const auto all = processes(k);
    add(log.turn, all[0]), add(log.push, all[1]);
    for (std::size_t g = 0; g < kShownGroups; ++g) add(sum.shown[g], all[2 + g]);
    if (layout.motors < 0 || noise_.q_motor <= 0) continue;
    const auto E = chunk::E(results_[k], n);
    const VectorXd d = defect(k), W = link_weight(k);
    for (int r = layout.motors; r < layout.motors + layout.rotors; ++r) {
      const VectorXd e = E.row(r).head(n).transpose();
      const double left = d[r] + e.dot(dx[k]) + E.row(r).tail(theta_->size()).dot(du) - dx[k + 1][r];
      const double V = e.dot(P[k].leftCols(n) * e) - 2 * cross[k].row(r).head(n).dot(e) + P[k + 1](r, r);
      sum.motors.add(left, W[r], V, h, noise_.q_motor);
    }
  }
  return sum;
}

double FlightSmoother::update_noise(const LinkMoments& moments, NoisePaces& paces) {
  double change = 0;
  for (std::size_t log = 0; log < moments.logs.size(); ++log)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [turn, push] = moments.logs[log];
      change = std::max({change, turn[i].update(noise_.air[log].w_dot[i], paces.logs[log][i], kSlowest),
                         push[i].update(noise_.air[log].v_dot[i], paces.logs[log][3 + i], kSlowest)});
    }
  for (std::size_t g = 0; g < kShownGroups; ++g)
    for (std::size_t i = 0; i < 3 && record_->layout.shown_error[g] >= 0; ++i) {
      ColouredNoise& error = noise_.slow[g][i];
      const ColouredNoise& seen = record_->slow[g][i];
      const double before = error.sigma;
      const double wanted = moments.shown[g][i].update(error, paces.shown[g][i], kSlowestShown);
      error.sigma = std::min(error.sigma, seen.sigma * std::sqrt(kMostDense * error.tau / seen.tau));
      if (wanted > 0) change = std::max(change, std::abs(error.sigma / before - 1));
    }
  return std::max(change, moments.motors.update(noise_.q_motor));
}

double FlightSmoother::retune(int rounds, bool eliminated) {
  const Stage stage("process noise");
  double change = 0;
  VectorXd du;
  NoisePaces paces{.logs = std::vector<std::array<Pace, 6>>(noise_.air.size()), .shown = {}};
  for (int round = 0; round < rounds; ++round) {
    const bool many = shared() >= kManyShared;
    const bool again = many ? round == 0 || round == 3 : round % kHeld == 0 || round <= 2;
    if (round > 0) eliminate(again ? nullptr : &du);
    if (again) du = shared_optimum();
    change = update_noise(link_moments(du), paces);
    if (change < kStill) break;
  }
  if (eliminated)
    eliminate();
  else
    eliminated_ = false;
  return change;
}

}  // namespace ident
