// Prediction errors of windows of held-out flight, and their floor from sensors, state error and gusts.
#include "ident/flight/fit/prediction.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "ident/flight/fit/prediction_windows.h"
#include "ident/flight/smoother/input_error.h"

namespace ident {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Sets the variance of a constant acceleration that moves velocities as much as the process does by the end
// of the window: the integral of the process over T has the variance 2 s^2 tau (T - tau (1 - exp(-T/tau))).
void expect_outside(RowMatrix& P, int at, const std::array<ColouredNoise, 3>& noise, double horizon) {
  const double T = horizon;
  for (int i = 0; i < 3 && at >= 0; ++i) {
    const ColouredNoise& axis = noise[static_cast<std::size_t>(i)];
    const double moved = 2 * axis.tau * (T - axis.tau * (1 - axis.carried(T))) / (T * T);
    P.row(at + i).setZero(), P.col(at + i).setZero();
    P(at + i, at + i) = axis.sigma * axis.sigma * moved;
  }
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
  const double shortest = *std::ranges::min_element(options.horizons);
  const FlightWindows starts(record, theta, u, noise,
                             {options.history, options.spacing, shortest, options.steps, options.threads});
  std::vector<std::vector<PredictionWindow>> all(options.horizons.size());
  const auto predict = [&](std::size_t w, double horizon) {
    const FlightArc& arc = record.arcs[starts[w].arc];
    ChunkTask one = starts.task(w, horizon);
    const StateLayout& layout = one.layout;
    RowMatrix P = starts.covariance(w);
    // No model predicts gusts: they count in the floor.
    expect_outside(P, layout.w_dot, noise.in_log(arc.log).w_dot, horizon);
    expect_outside(P, layout.v_dot, noise.in_log(arc.log).v_dot, horizon);
    // Slow errors go on from what they were; taken half way through the window.
    for (std::size_t g = 0; g < kShownGroups; ++g)
      for (int i = 0; i < 3 && layout.shown_error[g] >= 0; ++i) {
        const ColouredNoise& error = noise.slow[g][static_cast<std::size_t>(i)];
        const double share = error.carried(horizon / 2);
        P(layout.shown_error[g] + i, layout.shown_error[g] + i) +=
            error.sigma * error.sigma * (1 - share * share);
      }
    if (one.end < arc.rows()) {
      const AccelerationVariance error = input_error(record, arc, one.begin, one.end, noise.axes);
      for (int i = 0; i < 3; ++i) {
        if (layout.w_dot >= 0) P(layout.w_dot + i, layout.w_dot + i) += error[i];
        if (layout.v_dot >= 0) P(layout.v_dot + i, layout.v_dot + i) += error[3 + i];
      }
    }
    for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n)
      P(layout.motors + n, layout.motors + n) += noise.q_motor * horizon / 2;
    one.covariance = P.data();
    one.jacobian = options.floors, one.products = false, one.few_leverages = true;
    ChunkResult result;
    PredictionWindow window;
    if (one.end >= arc.rows()) return window;  // ends before the window does
    evaluate_chunk(one, result);
    window.log = arc.log, window.t = arc.t[starts[w].row];
    window.square = result.square, window.count = result.count;
    for (std::size_t c = 0; c < kChannels; ++c)
      window.floor[c] = options.floors ? result.count[c] + result.leverage[c] : kNaN;
    return window;
  };
  for (std::size_t h = 0; h < options.horizons.size(); ++h) {
    std::vector<PredictionWindow> windows(starts.size());
    starts.in_parallel([&](std::size_t w) { windows[w] = predict(w, options.horizons[h]); });
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
  std::vector<double> errors;
  for (const PredictionWindow& w : windows) e += errors.emplace_back(w.error2()), f += w.floor2();
  out.error = std::sqrt(e / static_cast<double>(windows.size()));
  out.floor = std::sqrt(f / static_cast<double>(windows.size()));
  std::mt19937_64 random(20);
  std::vector<double> draws;
  for (int b = 0; b < 400; ++b) {
    double sum = 0;
    for (std::size_t i = 0; i < windows.size(); ++i) sum += errors[random() % errors.size()];
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
  std::vector<std::array<double, 3>> squares;
  for (std::size_t i = 0; i < n; ++i)
    squares.push_back({before[i].error2(), after[i].error2(), after[i].floor2()});
  const auto closed = [&](auto&& pick) {
    double b = 0, a = 0, f = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto& [was, is, least] = squares[pick(i)];
      b += was, a += is, f += least;
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
