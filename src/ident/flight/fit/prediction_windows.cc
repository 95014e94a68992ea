// Estimates the state at the start of every window from its history, with the constants held.
#include "ident/flight/fit/prediction_windows.h"

#include <algorithm>

#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/record/excerpts.h"

namespace ident {
namespace {

constexpr int kRounds = 30;            // until states are at their optimum: many without rates and attitude
constexpr double kAtTheirBest = 1e-3;  // of the cost

// The rows [begin, end) of an arc as an arc of its own, with the gyro bias taken off.
FlightArc piece(const FlightArc& arc, std::size_t begin, std::size_t end, const std::array<double, 3>& bias) {
  FlightArc out = arc.piece(begin, end);
  for (std::size_t i = 0; i < out.rows(); ++i)
    for (std::size_t k = 0; k < 3; ++k) out.y[i * kChannels + k] -= bias[k];
  return out;
}

std::size_t row_at(const FlightArc& arc, double t) {
  return static_cast<std::size_t>(std::lower_bound(arc.t.begin(), arc.t.end(), t) - arc.t.begin());
}

std::vector<FlightWindow> window_starts(const FlightRecord& record, const WindowOptions& options) {
  std::vector<FlightWindow> windows;
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    for (double t = arc.t.front() + options.history; t + options.shortest < arc.t.back();
         t += options.spacing)
      windows.push_back({a, row_at(arc, t - options.history), row_at(arc, t)});
  }
  return windows;
}

}  // namespace

FlightWindows::FlightWindows(const FlightRecord& record, const Theta& theta, const Eigen::VectorXd& u,
                             const NoiseModel& noise, const WindowOptions& options)
    : record_(&record),
      theta_(&theta),
      u_(u),
      steps_(options.steps),
      p_(theta.p(u)),
      windows_(window_starts(record, options)),
      past_(without_arcs(record)) {
  for (std::size_t c = 0; c < kChannels; ++c) weight_[c] = 1.0 / noise.sigma[c];
  if (windows_.empty()) return;
  for (const FlightWindow& w : windows_)
    past_.arcs.push_back(
        piece(record.arcs[w.arc], w.first, w.row + 1, theta.gyro_bias(u, record.arcs[w.arc].log)));
  fixed_ = std::make_unique<Theta>(p_, std::vector<FreeConstant>{}, 1, false);
  smoother_ = std::make_unique<FlightSmoother>(
      past_, *fixed_, noise, std::clamp(chunk_for(record, noise), 0.04, 0.4), options.threads);
  smoother_->set_steps(steps_);
  smoother_->settle_ends(Eigen::VectorXd(0), kRounds, kAtTheirBest);
  ends_ = smoother_->arc_ends();
}

ChunkTask FlightWindows::task(std::size_t w, double horizon) const {
  const FlightArc& arc = record_->arcs[windows_[w].arc];
  ChunkTask task;
  task.vehicle = record_->vehicle, task.layout = record_->layout;
  task.p = p_, task.active = active_effects(p_);
  task.weight = weight_.data();
  task.steps = steps_;
  task.huber = 1e6;  // errors of a wrong model count in full
  task.inputs = arc.inputs.get(), task.gyro_bias = theta_->gyro_bias(u_, arc.log);
  task.begin = windows_[w].row, task.rows = arc.rows();
  task.end = row_at(arc, arc.t[windows_[w].row] + horizon);
  task.t = arc.t.data(), task.y = arc.y.data(), task.q = arc.q.data();
  task.x0 = ends_[w].x;
  task.x0.outside = {.axes = task.x0.outside.axes};
  return task;
}

void FlightWindows::in_parallel(const std::function<void(std::size_t)>& work) const {
  if (smoother_) smoother_->in_parallel(windows_.size(), work);
}

}  // namespace ident
