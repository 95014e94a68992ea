// Sums of rotation vectors between samples, and their differences over windows.
#include "ident/flight/join/running_turn.h"

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

using Eigen::Vector3d;

const Vector3d kNowhere = Vector3d::Constant(kNaN);

template <std::size_t N>
bool sampled(const std::array<std::vector<double>, N>& columns, std::size_t i) {
  return std::ranges::all_of(columns, [&](const std::vector<double>& c) { return std::isfinite(c[i]); });
}

}  // namespace

double RunningTurn::interval() const {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  return steps.empty() ? 0.0 : median(steps);
}

RunningTurn turn_of_attitudes(const FlightLog& log) {
  RunningTurn out;
  if (!log.has_attitude()) return out;
  Vector3d sum = Vector3d::Zero();
  Eigen::Vector4d before = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < log.rows(); ++i) {
    if (!sampled(log.q_WB, i)) continue;
    const Eigen::Vector4d q(log.q_WB[0][i], log.q_WB[1][i], log.q_WB[2][i], log.q_WB[3][i]);
    if (!out.t.empty())
      sum += rotation_vector_from_quaternion(quaternion_product(Eigen::Vector4d(conjugate(before)), q));
    out.t.push_back(log.t[i]), out.turn.push_back(sum);
    before = q;
  }
  return out;
}

RunningTurn turn_of_gyro(const FlightLog& log) {
  RunningTurn out;
  if (!log.has_rates()) return out;
  Vector3d sum = Vector3d::Zero(), before = sum;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    if (!sampled(log.w_B, i)) continue;
    const Vector3d w(log.w_B[0][i], log.w_B[1][i], log.w_B[2][i]);
    if (!out.t.empty()) sum += 0.5 * (log.t[i] - out.t.back()) * (before + w);
    out.t.push_back(log.t[i]), out.turn.push_back(sum);
    before = w;
  }
  return out;
}

Vector3d MeanRate::at(double t) {
  const Vector3d early = turned_at(t - width_ / 2, early_), late = turned_at(t + width_ / 2, late_);
  return (late - early) / width_;
}

Vector3d MeanRate::turned_at(double t, std::size_t& row) const {
  const std::vector<double>& times = turn_.t;
  if (times.size() < 2 || t < times.front() || t > times.back()) return kNowhere;
  if (t < times[row])  // times that rise go on from the last row
    row = static_cast<std::size_t>(std::ranges::upper_bound(times, t) - times.begin()) - 1;
  while (row + 2 < times.size() && times[row + 1] <= t) ++row;
  const double step = times[row + 1] - times[row];
  if (!(step < 2 * width_)) return kNowhere;
  const double share = (t - times[row]) / step;
  return turn_.turn[row] + share * (turn_.turn[row + 1] - turn_.turn[row]);
}

}  // namespace ident
