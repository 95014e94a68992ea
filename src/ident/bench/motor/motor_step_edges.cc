// One state and one perturbation for each edge, carried from row to row.
#include "ident/bench/motor/motor_step_edges.h"

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"
#include "ident/model/motor.h"

namespace ident {
namespace {

constexpr double kPause =
    4.0;  // usual distances of rows: rows that were lost one by one leave gaps of 2 or 3

/// omega_m, zeta_m and the target that hold between two edges.
struct Regime {
  double omega_m, zeta_m, target;

  Eigen::Vector2d rate(const Eigen::Vector2d& x) const {
    return {x(1), omega_m * omega_m * (target - x(0)) - 2.0 * zeta_m * omega_m * x(1)};
  }
};

}  // namespace

std::size_t count_steps(const std::vector<StepRecord>& records) {
  std::size_t steps = 0;
  for (const StepRecord& record : records) steps += record.edges.size() - 1;
  return steps;
}

StepRecord with_shifted_edges(StepRecord record, const Eigen::VectorXd& shift) {
  for (std::size_t e = 1; e < record.edges.size(); ++e)
    record.edges[e].t =
        std::max(record.edges[e].t + shift(static_cast<Eigen::Index>(e) - 1), record.edges[e - 1].t);
  return record;
}

Eigen::MatrixXd edge_time_slopes(const StepRecord& record, const Eigen::VectorXd& target,
                                 const Eigen::Vector2d& start, const MotorShape& shape) {
  const auto rows = static_cast<Eigen::Index>(record.rows());
  const auto steps = static_cast<Eigen::Index>(record.edges.size()) - 1;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(rows, steps);
  Eigen::Matrix2Xd moved = Eigen::Matrix2Xd::Zero(2, steps);  // derivative of the state by each edge's time
  Eigen::Vector2d x = start;
  Regime regime{shape.omega_m, shape.zeta_m, target(0)};
  Eigen::Index begin = 0, end = 0;  // edges that have passed, and of which something is left
  double now = record.t.front(), h_known = -1.0, omega_known = 0.0;
  Eigen::Matrix2d P = Eigen::Matrix2d::Identity();
  const auto advance = [&](double to) {
    const double h = to - now;
    now = to;
    if (h <= 0.0) return;
    if (std::fabs(h - h_known) > 1e-11 || regime.omega_m != omega_known) {
      const MotorTransition<double> p = motor_transition(regime.omega_m, regime.zeta_m, h);
      P << p.p11, p.p12, p.p21, p.p22;
      h_known = h, omega_known = regime.omega_m;
    }
    const Eigen::Vector2d steady(regime.target, 0.0);
    x = steady + P * (x - steady);
    for (Eigen::Index e = begin; e < end; ++e) moved.col(e) = P * moved.col(e);
  };
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double sample = record.t[static_cast<std::size_t>(i)];
    while (end < steps && record.edges[static_cast<std::size_t>(end) + 1].t + shape.dead_time <= sample) {
      const CommandEdge& edge = record.edges[static_cast<std::size_t>(end) + 1];
      const double at = edge.t + shape.dead_time;
      const bool before_start = at < record.t.front();
      if (!before_start) advance(std::max(at, now));
      const Regime next{(edge.down ? shape.down_ratio : 1.0) * shape.omega_m, shape.zeta_m, target(end + 1)};
      if (!before_start) moved.col(end) = regime.rate(x) - next.rate(x);  // (1)
      regime = next;
      ++end;
    }
    advance(sample);
    while (begin < end && moved.col(begin).norm() < 1e-12 * std::fabs(regime.target)) ++begin;
    slopes.row(i).segment(begin, end - begin) = moved.row(0).segment(begin, end - begin);
  }
  return slopes;
}

RecorderPauses recorder_pauses(const std::vector<StepRecord>& records, double answer_time) {
  RecorderPauses found;
  std::vector<double> distances;
  for (const StepRecord& record : records)
    for (std::size_t i = 1; i < record.rows(); ++i) distances.push_back(record.t[i] - record.t[i - 1]);
  if (distances.empty()) return found;
  found.usual = median(distances);
  for (const StepRecord& record : records)
    for (std::size_t e = 1; e < record.edges.size(); ++e) {
      double longest = 0.0;
      for (std::size_t i = 1; i < record.rows(); ++i)
        // The row of an edge begins its answer: what lies before it is the step before, settled rows left
        // out.
        if (record.t[i] > record.edges[e].t && record.t[i - 1] <= record.edges[e].t + answer_time)
          longest = std::max(longest, record.t[i] - record.t[i - 1]);
      if (longest < kPause * found.usual) continue;
      ++found.steps;
      found.longest = std::max(found.longest, longest);
    }
  return found;
}

}  // namespace ident
