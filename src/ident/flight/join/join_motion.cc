// Rows of both files on one axis of time.
#include "ident/flight/join/join_motion.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/flight/join/match_motion.h"

namespace ident {
namespace {

constexpr double kSameRow = 1e-5;     // s
constexpr double kUnseen = 0.5;       // s without a sample of the recording that are not used
constexpr double kTurnKnown = 0.035;  // rad: with less the axes of the bodies count as alike

using Column = std::vector<double>;

// Rows of the log, and those of the recording between and on them.
struct Rows {
  std::vector<double> t;
  std::vector<std::size_t> of_log;              // where each row of the log went
  std::vector<std::size_t> from, of_recording;  // rows of the recording that are used, and where they went
};

Rows merged(const FlightLog& log, const FlightLog& recording, const MotionMatch& match) {
  Rows rows;
  std::size_t k = 0;
  const auto place = [&](double until) {
    for (; k < recording.rows() && match.to_log(recording.t[k]) < until; ++k) {
      const double t = match.to_log(recording.t[k]);
      if (t < log.t.front() || !std::isfinite(recording.q_WB[0][k])) continue;
      if (rows.t.empty() || t - rows.t.back() > kSameRow) rows.t.push_back(t);
      rows.from.push_back(k), rows.of_recording.push_back(rows.t.size() - 1);
    }
  };
  for (const double t : log.t) {
    place(t - kSameRow);
    rows.of_log.push_back(rows.t.size());
    rows.t.push_back(t);
  }
  return rows;
}

Column spread(const Column& values, const std::vector<std::size_t>& to, std::size_t rows) {
  if (values.empty()) return {};
  Column out(rows, kNaN);
  for (std::size_t i = 0; i < values.size(); ++i) out[to[i]] = values[i];
  return out;
}

// A command holds until the next one.
Column held(Column values) {
  for (std::size_t i = 1; i < values.size(); ++i)
    if (std::isnan(values[i])) values[i] = values[i - 1];
  return values;
}

template <std::size_t N>
void take(std::array<Column, N>& to, const std::array<Column, N>& from, const Rows& rows) {
  for (std::size_t k = 0; k < N; ++k) {
    to[k].clear();
    if (from[k].empty()) continue;
    to[k].assign(rows.t.size(), kNaN);
    for (std::size_t i = 0; i < rows.from.size(); ++i) to[k][rows.of_recording[i]] = from[k][rows.from[i]];
  }
}

void turn_body(std::array<Column, 4>& q_WB, const Eigen::Matrix3d& turn) {
  const Eigen::Quaterniond back(Eigen::Matrix3d(turn.transpose()));
  const Eigen::Vector4d by(back.w(), back.x(), back.y(), back.z());
  for (std::size_t i = 0; i < q_WB[0].size(); ++i) {
    const Eigen::Vector4d q =
        quaternion_product(Eigen::Vector4d(q_WB[0][i], q_WB[1][i], q_WB[2][i], q_WB[3][i]), by);
    for (std::size_t k = 0; k < 4; ++k) q_WB[k][i] = q[static_cast<Eigen::Index>(k)];
  }
}

// Parts of the log that the recording does not show.
std::vector<std::array<double, 2>> unseen(const Rows& rows) {
  std::vector<std::array<double, 2>> out;
  double last = rows.t.front();
  for (const std::size_t row : rows.of_recording) {
    if (rows.t[row] - last > kUnseen) out.push_back({last, rows.t[row]});
    last = rows.t[row];
  }
  if (rows.t.back() - last > kUnseen) out.push_back({last, rows.t.back() + kSameRow});
  return out;
}

std::string in_words(const FlightLog& log, const FlightLog& recording, const MotionMatch& match, bool turned,
                     double left_out) {
  std::string text = fmt::format(
      "{}: attitude and position are those of {}, {:.4f} s (± {:.2g} ms) after its own times, with clocks "
      "that "
      "drift by {:.0f} ppm; {:.1f} % of the rates agree",
      log.file, recording.file, match.offset, 1e3 * match.std, 1e6 * match.drift + 0.0, 100 * match.alike);
  const double angle = Eigen::AngleAxisd(match.turn).angle();
  if (turned)
    text +=
        fmt::format("; its body's axes are turned by {:.2g} deg, which was taken back", angle * 180 / M_PI);
  if (left_out > 0) text += fmt::format("; {:.1f} s that it does not show are left out", left_out);
  return text;
}

}  // namespace

FlightLog with_motion(FlightLog log, const FlightLog& recording) {
  const MotionMatch match = match_motion(log, recording);
  const Rows rows = merged(log, recording, match);
  if (rows.from.empty()) throw DataError(recording.file + ": none of it lies on " + log.file);
  const std::size_t n = rows.t.size();
  for (Column& delta : log.delta) delta = held(spread(delta, rows.of_log, n));
  for (Column& Omega : log.Omega) Omega = spread(Omega, rows.of_log, n);
  for (Column& w : log.w_B) w = spread(w, rows.of_log, n);
  for (Column& f : log.f_B) f = spread(f, rows.of_log, n);
  log.vbat = spread(log.vbat, rows.of_log, n);
  log.current = spread(log.current, rows.of_log, n);
  take(log.q_WB, recording.q_WB, rows);
  take(log.x_W, recording.x_W, rows);
  take(log.v_W, recording.v_W, rows);
  log.t = rows.t;
  const bool turned = match.turn_std < kTurnKnown;
  if (turned) turn_body(log.q_WB, match.turn);
  double left_out = 0;
  for (const auto& part : unseen(rows)) {
    log.left_out.push_back(part);
    left_out += part[1] - part[0];
  }
  log.warnings.insert(log.warnings.end(), recording.warnings.begin(), recording.warnings.end());
  log.notices.insert(log.notices.end(), recording.notices.begin(), recording.notices.end());
  log.notices.push_back(in_words(log, recording, match, turned, left_out));
  return log;
}

}  // namespace ident
