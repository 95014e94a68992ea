// A quaternion read as it is written turns with the rates; of those that are read otherwise at most one does.
#include "ident/io/log/log_quaternion.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "ident/core/error.h"

namespace ident {
namespace {

constexpr double kWindow = 0.04, kLongest = 0.2;  // s
constexpr double kTurned = 1.0;                   // rad, root of the sum of squares over all windows
constexpr double kWrong = 0.6, kRight = 0.25;     // of that sum, what the rates leave

/// How the four columns may be meant: which of them is w, x, y, z; and whose attitude in whose axes.
struct Reading {
  std::array<std::size_t, 4> wxyz;
  bool conjugate;
  const char* what;
};
constexpr std::array kReadings = {
    Reading{{0, 1, 2, 3}, false, ""},
    Reading{{0, 1, 2, 3}, true, "conjugate"},
    Reading{{3, 0, 1, 2}, false, "x, y, z, w (scalar last) they do: name the last of them qw"},
    Reading{{1, 2, 3, 0}, false, "w, x, y, z (scalar first) they do: name the first of them qw"},
    Reading{{3, 0, 1, 2}, true, "x, y, z, w (scalar last) of the world in the body they do"},
    Reading{{1, 2, 3, 0}, true, "w, x, y, z (scalar first) of the world in the body they do"}};

Eigen::Quaterniond attitude(const FlightLog& log, std::size_t row, const Reading& as) {
  const auto at = [&](std::size_t k) { return log.q_WB[as.wxyz[k]][row]; };
  const Eigen::Quaterniond q(at(0), at(1), at(2), at(3));
  return as.conjugate ? q.conjugate() : q;
}

Eigen::Vector3d turn(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::Quaterniond step = from.conjugate() * to;
  return (step.w() < 0 ? -2.0 : 2.0) * step.vec();  // small
}

/// Of the squared turns between attitudes, in rad^2: all, and what the rates leave of them by each reading.
struct Turns {
  double all = 0;
  std::array<double, kReadings.size()> left{};
};

Turns turns_of(const FlightLog& log) {
  Turns turns;
  Eigen::Vector3d by_rates = Eigen::Vector3d::Zero();
  std::optional<std::size_t> start, last;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    const Eigen::Vector3d w(log.w_B[0][i], log.w_B[1][i], log.w_B[2][i]);
    if (w.allFinite()) {
      if (last) by_rates += (log.t[i] - log.t[*last]) * w;
      last = i;
    }
    if (std::isnan(log.q_WB[0][i])) continue;
    const double passed = start ? log.t[i] - log.t[*start] : 0.0;
    if (start && passed < kWindow) continue;
    if (start && passed < kLongest)
      for (std::size_t k = 0; k < kReadings.size(); ++k) {
        const Eigen::Vector3d by_attitude =
            turn(attitude(log, *start, kReadings[k]), attitude(log, i, kReadings[k]));
        if (k == 0) turns.all += by_attitude.squaredNorm();
        turns.left[k] += (by_attitude - by_rates).squaredNorm();
      }
    start = i, by_rates.setZero();
  }
  return turns;
}

}  // namespace

void check_quaternion(FlightLog& log, long header_line) {
  if (!log.has_attitude() || std::ranges::any_of(log.w_B, &std::vector<double>::empty)) return;
  const Turns turns = turns_of(log);
  if (!(turns.all > kTurned * kTurned) || !(turns.left[0] > kWrong * turns.all)) return;
  const auto best = static_cast<std::size_t>(std::ranges::min_element(turns.left) - turns.left.begin());
  if (!(turns.left[best] < kRight * turns.all)) return;
  if (best > 1)
    throw InputError(
        log.file, header_line, "qw, qx, qy, qz",
        fmt::format("do not turn with the rates in this order; taken as {}", kReadings[best].what));
  log.warnings.push_back({"wrong_frame", log.file + ": attitude: turns against the rates about all axes: it "
                                                    "is that of the world in the body; conjugate it (or "
                                                    "reverse p, q and r, if these are of the other sign)"});
}

}  // namespace ident
