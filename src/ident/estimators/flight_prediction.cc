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
  FlightArc out;
  out.log = 0;
  const auto range = [&](const auto& v, std::size_t width) {
    return std::decay_t<decltype(v)>(v.begin() + static_cast<std::ptrdiff_t>(begin * width),
                                     v.begin() + static_cast<std::ptrdiff_t>(end * width));
  };
  out.t = range(arc.t, 1), out.y = range(arc.y, kChannels), out.q = range(arc.q, 4),
  out.start = range(arc.start, 1);
  out.inputs = arc.inputs;
  for (std::size_t i = 0; i < out.rows(); ++i)
    for (std::size_t k = 0; k < 3; ++k) out.y[i * kChannels + k] -= bias[k];
  return out;
}

struct Start {
  std::size_t arc, first, row;  ///< history from `first`, window from `row`
};

std::vector<Start> window_starts(const FlightRecord& record, const PredictionOptions& options) {
  std::vector<Start> starts;
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    for (double t = arc.t.front() + options.history; t + options.horizon < arc.t.back();
         t += options.spacing) {
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

std::vector<PredictionWindow> predict_windows(const FlightRecord& record, const Theta& theta,
                                              const Eigen::VectorXd& u, const NoiseModel& noise,
                                              const PredictionOptions& options) {
  const std::vector<double> p = theta.p(u);
  const Theta fixed(p, {}, 1, false);
  FlightRecord past = record;
  past.arcs.clear();
  past.logs = 1;
  const std::vector<Start> starts = window_starts(record, options);
  if (starts.empty()) return {};
  for (const Start& s : starts)
    past.arcs.push_back(
        piece(record.arcs[s.arc], s.first, s.row + 1, theta.gyro_bias(u, record.arcs[s.arc].log)));
  FlightSmoother smoother(past, fixed, noise, std::clamp(chunk_for(record, noise), 0.04, 0.4),
                          options.threads);
  const Eigen::VectorXd none(0);
  smoother.settle(none, 3);
  const std::vector<FlightSmoother::End> ends = smoother.arc_ends();
  std::array<double, kChannels> weight;
  for (std::size_t c = 0; c < kChannels; ++c) weight[c] = 1.0 / noise.sigma[c];
  std::vector<PredictionWindow> windows;
  ChunkResult result;
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  for (std::size_t w = 0; w < starts.size(); ++w) {
    const FlightArc& arc = record.arcs[starts[w].arc];
    const auto last = static_cast<std::size_t>(
        std::lower_bound(arc.t.begin(), arc.t.end(), arc.t[starts[w].row] + options.horizon) - arc.t.begin());
    // Gusts over half the horizon stand for their growth along the window.
    RowMatrix P = ends[w].P;
    const double h = options.horizon / 2;
    const StateLayout& layout = record.layout;
    for (int i = 0; i < 3; ++i) {
      P(layout.w + i, layout.w + i) += noise.q_w * h;
      if (layout.attitude >= 0) P(layout.attitude + i, layout.attitude + i) += noise.q_w * h * h * h / 3;
      if (layout.v >= 0) P(layout.v + i, layout.v + i) += noise.q_v * h;
      if (layout.x >= 0) P(layout.x + i, layout.x + i) += noise.q_v * h * h * h / 3;
    }
    for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n)
      P(layout.motors + n, layout.motors + n) += noise.q_motor * h;
    ChunkTask task;
    task.vehicle = record.vehicle, task.inputs = &arc.inputs, task.layout = layout;
    task.p = p;
    task.gyro_bias = theta.gyro_bias(u, arc.log);
    task.active = theta.active();
    task.begin = starts[w].row, task.end = std::min(last, arc.rows() - 1), task.rows = arc.rows();
    task.t = arc.t.data(), task.y = arc.y.data(), task.q = arc.q.data(), task.weight = weight.data();
    task.huber = 1e6;  // errors of a wrong model count in full
    task.x0 = ends[w].x;
    task.covariance = P.data();
    evaluate_chunk(task, result);
    PredictionWindow window;
    window.log = arc.log, window.t = arc.t[starts[w].row];
    window.square = result.square, window.count = result.count;
    for (std::size_t c = 0; c < kChannels; ++c) window.floor[c] = result.count[c] + result.leverage[c];
    if (std::isfinite(window.error2())) windows.push_back(window);
  }
  return windows;
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
    return b > 1.02 * f ? 1 - (a - f) / (b - f) : kNaN;
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
