// Differences of what was gained from the first row of a window to its last.
#include "ident/flight/ladder/window_residuals.h"

#include <algorithm>
#include <cmath>

#include "ident/flight/ladder/speeds_along.h"

namespace ident {
namespace {

using Eigen::VectorXd;

constexpr double kForceHorizon = 0.5, kForceSpacing = 0.1;     // s: users judge by half a second
constexpr double kMomentHorizon = 0.1, kMomentSpacing = 0.05;  // s: rates are turned back sooner
constexpr double kUsual = 0.01;
constexpr double kSpeedHorizon = 0.05, kSpeedSpacing = 0.05;  // s: about the lag of a motor

// Takes out windows in which no speed was measured.
void leave_measured(std::vector<Window>& windows, const MeasuredMotion& motion) {
  const std::vector<std::vector<RotorSpeeds>> measured = measured_speeds(motion);
  const auto rotors = std::ssize(motion.record->vehicle->rotors);
  std::erase_if(windows, [&](const Window& w) {
    const auto rows = std::span(measured[w.arc]).subspan(w.begin, w.end - w.begin);
    return std::ranges::none_of(rows, [&](const RotorSpeeds& row) {
      return std::any_of(row.begin(), row.begin() + rotors, [](double y) { return std::isfinite(y); });
    });
  });
}

VectorXd missed_speeds(const MeasuredMotion& motion, const std::vector<Window>& windows,
                       std::span<const double> p) {
  const std::vector<std::vector<RotorSpeeds>> measured = measured_speeds(motion),
                                              model = speeds_along(motion, p);
  const std::size_t rotors = motion.record->vehicle->rotors.size();
  VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(rotors * windows.size()));
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const auto& [a, begin, end, t, speed] = windows[w];
    for (std::size_t n = 0; n < rotors; ++n) {
      double sum = 0, count = 0;
      for (std::size_t i = begin; i < end; ++i)
        if (const double miss = measured[a][i][n] - model[a][i][n]; std::isfinite(miss))
          sum += miss, count += 1;
      if (count > 0) out[static_cast<Eigen::Index>(rotors * w + n)] = sum / count;
    }
  }
  return out;
}

}  // namespace

double horizon_of(FitTo what) {
  return what == FitTo::forces ? kForceHorizon : what == FitTo::moments ? kMomentHorizon : kSpeedHorizon;
}

std::vector<Window> windows_of(const MeasuredMotion& motion, FitTo what) {
  const double spacing = what == FitTo::forces    ? kForceSpacing
                         : what == FitTo::moments ? kMomentSpacing
                                                  : kSpeedSpacing;
  std::vector<Window> windows = windows_of(motion, horizon_of(what), spacing);
  if (what == FitTo::speeds) leave_measured(windows, motion);
  return windows;
}

Eigen::VectorXd missed_in(const MeasuredMotion& motion, const std::vector<Window>& windows, FitTo what,
                          const std::vector<ModelAlong>& model) {
  Eigen::VectorXd out(3 * static_cast<Eigen::Index>(windows.size()));
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const auto& [a, begin, end, t, speed] = windows[w];
    const MeasuredArc& measured = motion.arcs[a];
    const Vec3<double> miss = what == FitTo::forces
                                  ? Vec3<double>(measured.gained_W[end] - measured.gained_W[begin] -
                                                 (model[a].gained_W[end] - model[a].gained_W[begin]))
                                  : Vec3<double>(measured.body[end].w_B - measured.body[begin].w_B -
                                                 (model[a].turned_B[end] - model[a].turned_B[begin]));
    out.segment<3>(3 * static_cast<Eigen::Index>(w)) = miss;
  }
  return out;
}

Eigen::VectorXd missed_by(const MeasuredMotion& motion, const std::vector<Window>& windows, FitTo what,
                          std::span<const double> p) {
  if (what == FitTo::speeds) return missed_speeds(motion, windows, p);
  return missed_in(motion, windows, what, model_along(motion, p));
}

std::vector<VectorXd> usual_errors_of_speeds(const MeasuredMotion& motion, const std::vector<Window>& windows,
                                             std::span<const double> p) {
  if (windows.empty()) return {};
  const std::vector<std::vector<RotorSpeeds>> model = speeds_along(motion, p);
  const std::size_t rotors = motion.record->vehicle->rotors.size();
  const double full = p[param::Omega_0] + p[param::km];
  const double begin = windows.front().t, seconds = std::max(windows.back().t - begin, 1e-9);
  VectorXd bent(static_cast<Eigen::Index>(rotors * windows.size())), drifts = bent;
  for (std::size_t w = 0; w < windows.size(); ++w)
    for (std::size_t n = 0; n < rotors; ++n) {
      const double Omega = model[windows[w].arc][windows[w].begin][n];
      const auto at = static_cast<Eigen::Index>(rotors * w + n);
      bent[at] = kUsual * 4 * Omega * (1 - Omega / full);
      drifts[at] = kUsual * Omega * (2 * (windows[w].t - begin) / seconds - 1);
    }
  return {bent, drifts};
}

VectorXd missed_by_late_rates(const MeasuredMotion& motion, const std::vector<Window>& windows,
                              const std::vector<ModelAlong>& model) {
  const auto acceleration = [&](std::size_t arc, std::size_t i) -> Vec3<double> {
    const std::vector<double>& t = motion.arcs[arc].t;
    const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, t.size() - 1);
    return (model[arc].turned_B[after] - model[arc].turned_B[before]) / (t[after] - t[before]);
  };
  VectorXd out(3 * static_cast<Eigen::Index>(windows.size()));
  for (std::size_t w = 0; w < windows.size(); ++w)
    out.segment<3>(3 * static_cast<Eigen::Index>(w)) =
        acceleration(windows[w].arc, windows[w].begin) - acceleration(windows[w].arc, windows[w].end);
  return out;
}

}  // namespace ident
