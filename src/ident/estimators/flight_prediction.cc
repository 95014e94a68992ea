// Windows of held-out flight: state from the past, prediction, and the floor from sensors, state error and
// gusts.
#include "ident/estimators/flight_prediction.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace ident {
namespace {

// The rows [begin, end) of an arc as an arc of its own, with the gyro bias taken off.
FlightArc piece(const FlightArc& arc, std::size_t begin, std::size_t end, const std::array<double, 3>& bias) {
  FlightArc out = arc.piece(begin, end);
  for (std::size_t i = 0; i < out.rows(); ++i)
    for (std::size_t k = 0; k < 3; ++k) out.y[i * kChannels + k] -= bias[k];
  return out;
}

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Covariance of an unknown constant acceleration that moves velocities as much as the process does by the end
// of the window: its integral over T has the variance 2 s^2 tau (T - tau (1 - exp(-T/tau))).
void expect_outside(RowMatrix& P, int at, const std::array<ColouredNoise, 3>& noise, double horizon) {
  const double T = horizon;
  for (int i = 0; i < 3 && at >= 0; ++i) {
    const ColouredNoise& axis = noise[static_cast<std::size_t>(i)];
    const double moved = 2 * axis.tau * (T - axis.tau * (1 - axis.carried(T))) / (T * T);
    P.row(at + i).setZero(), P.col(at + i).setZero();
    P(at + i, at + i) = axis.sigma * axis.sigma * moved;
  }
}

struct Start {
  std::size_t arc, first, row;  ///< history from `first`, window from `row`
};

std::vector<Start> window_starts(const FlightRecord& record, const PredictionOptions& options) {
  std::vector<Start> starts;
  const double shortest = *std::ranges::min_element(options.horizons);
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    for (double t = arc.t.front() + options.history; t + shortest < arc.t.back(); t += options.spacing) {
      const auto at = [&](double x) {
        return static_cast<std::size_t>(std::lower_bound(arc.t.begin(), arc.t.end(), x) - arc.t.begin());
      };
      starts.push_back({a, at(t - options.history), at(t)});
    }
  }
  return starts;
}

}  // namespace

double PredictionWindow::error2() const {
  double sum = 0, n = 0;
  for (std::size_t c = 0; c < kChannels; ++c)
    if (count[c] > 0) sum += square[c] / count[c], n += 1;
  return n > 0 ? sum / n : kNaN;
}

double PredictionWindow::floor2() const {
  double sum = 0, n = 0;
  for (std::size_t c = 0; c < kChannels; ++c)
    if (count[c] > 0) sum += floor[c] / count[c], n += 1;
  return n > 0 ? sum / n : kNaN;
}

std::vector<std::vector<PredictionWindow>> predict_windows(const FlightRecord& record, const Theta& theta,
                                                           const Eigen::VectorXd& u, const NoiseModel& noise,
                                                           const PredictionOptions& options) {
  const std::vector<double> p = theta.p(u);
  const Theta fixed(p, {}, 1, false);
  FlightRecord past = without_arcs(record);
  const std::vector<Start> starts = window_starts(record, options);
  std::vector<std::vector<PredictionWindow>> all(options.horizons.size());
  if (starts.empty()) return all;
  for (const Start& s : starts)
    past.arcs.push_back(
        piece(record.arcs[s.arc], s.first, s.row + 1, theta.gyro_bias(u, record.arcs[s.arc].log)));
  FlightSmoother smoother(past, fixed, noise, std::clamp(chunk_for(record, noise), 0.04, 0.4),
                          options.threads);
  smoother.settle(Eigen::VectorXd(0), 2);
  const std::vector<FlightSmoother::End> ends = smoother.arc_ends();
  std::array<double, kChannels> weight;
  for (std::size_t c = 0; c < kChannels; ++c) weight[c] = 1.0 / noise.sigma[c];
  ChunkTask task;
  task.vehicle = record.vehicle, task.layout = record.layout;
  task.p = p, task.active = active_effects(p);
  task.weight = weight.data();
  task.huber = 1e6;  // errors of a wrong model count in full
  const auto predict = [&](std::size_t w, double horizon) {
    const FlightArc& arc = record.arcs[starts[w].arc];
    const double until = arc.t[starts[w].row] + horizon;
    ChunkTask one = task;
    one.inputs = arc.inputs.get(), one.gyro_bias = theta.gyro_bias(u, arc.log);
    one.begin = starts[w].row, one.rows = arc.rows();
    one.end = static_cast<std::size_t>(std::lower_bound(arc.t.begin(), arc.t.end(), until) - arc.t.begin());
    one.t = arc.t.data(), one.y = arc.y.data(), one.q = arc.q.data();
    one.x0 = ends[w].x;
    one.x0.outside = {};  // no model predicts gusts: they count in the floor
    RowMatrix P = ends[w].P;
    expect_outside(P, task.layout.w_dot, noise.in_log(arc.log).w_dot, horizon);
    expect_outside(P, task.layout.v_dot, noise.in_log(arc.log).v_dot, horizon);
    for (int n = 0; n < task.layout.rotors && task.layout.motors >= 0; ++n)
      P(task.layout.motors + n, task.layout.motors + n) += noise.q_motor * horizon / 2;
    one.covariance = P.data();
    ChunkResult result;
    PredictionWindow window;
    if (one.end >= arc.rows()) return window;  // ends before the window does
    evaluate_chunk(one, result);
    window.log = arc.log, window.t = arc.t[starts[w].row];
    window.square = result.square, window.count = result.count;
    for (std::size_t c = 0; c < kChannels; ++c) window.floor[c] = result.count[c] + result.leverage[c];
    return window;
  };
  for (std::size_t h = 0; h < options.horizons.size(); ++h) {
    std::vector<PredictionWindow> windows(starts.size());
    smoother.in_parallel(starts.size(), [&](std::size_t w) { windows[w] = predict(w, options.horizons[h]); });
    std::erase_if(windows, [](const PredictionWindow& w) { return !std::isfinite(w.error2()); });
    all[h] = std::move(windows);
  }
  return all;
}

PredictionSummary summarise(const std::vector<PredictionWindow>& windows) {
  PredictionSummary out;
  out.windows = windows.size();
  if (windows.empty()) return out;
  double e = 0, f = 0;
  for (const PredictionWindow& w : windows) e += w.error2(), f += w.floor2();
  out.error = std::sqrt(e / static_cast<double>(windows.size()));
  out.floor = std::sqrt(f / static_cast<double>(windows.size()));
  std::mt19937_64 random(20);
  std::vector<double> draws;
  for (int b = 0; b < 400; ++b) {
    double sum = 0;
    for (std::size_t i = 0; i < windows.size(); ++i) sum += windows[random() % windows.size()].error2();
    draws.push_back(std::sqrt(sum / static_cast<double>(windows.size())));
  }
  std::ranges::sort(draws);
  out.ci95 = {draws[10], draws[389]};
  return out;
}

GapClosed gap_closed(const std::vector<PredictionWindow>& before,
                     const std::vector<PredictionWindow>& after) {
  GapClosed out;
  const std::size_t n = std::min(before.size(), after.size());
  if (n == 0) return out;
  const auto closed = [&](auto&& pick) {
    double b = 0, a = 0, f = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = pick(i);
      b += before[k].error2(), a += after[k].error2(), f += after[k].floor2();
    }
    const double k = static_cast<double>(n);
    out.before = std::sqrt(b / k), out.after = std::sqrt(a / k), out.floor = std::sqrt(f / k);
    return b > 1.02 * f ? std::min(1 - (a - f) / (b - f), 1.0) : kNaN;
  };
  std::mt19937_64 random(21);
  std::vector<double> draws;
  for (int d = 0; d < 400; ++d) {
    const double x = closed([&](std::size_t) { return random() % n; });
    if (std::isfinite(x)) draws.push_back(x);
  }
  out.closed = closed([](std::size_t i) { return i; });
  if (draws.size() > 200 && std::isfinite(out.closed)) {
    std::ranges::sort(draws);
    out.ci95 = {draws[draws.size() / 40], draws[draws.size() - 1 - draws.size() / 40]};
  }
  return out;
}

}  // namespace ident
