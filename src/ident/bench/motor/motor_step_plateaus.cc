// Finds plateaus between edges, the settling time of the motor, and rows long after it.
#include "ident/bench/motor/motor_step_plateaus.h"

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr std::size_t kManyRows = 3000;     // of all records: below it every row is kept
constexpr std::size_t kFewestSettled = 50;  // rows of a plateau that stay in any case
constexpr double kArrived = 0.9;            // of the way to the new level
constexpr double kSettledAfter = 12.0;      // times the median time of arrival

/// Time from each edge until the speed first is most of the way to its new level, s.
void add_arrivals(const StepRecord& record, std::vector<double>& arrivals) {
  const std::vector<Plateau> plateaus = plateaus_of(record);
  for (std::size_t p = 1; p < plateaus.size(); ++p) {
    const double from = plateaus[p - 1].level, way = plateaus[p].level - from;
    for (std::size_t i = plateaus[p].begin; i < plateaus[p].end; ++i) {
      if ((record.Omega[i] - from) * (way > 0.0 ? 1.0 : -1.0) < kArrived * std::fabs(way)) continue;
      arrivals.push_back(record.t[i] - record.t[plateaus[p].begin]);
      break;
    }
  }
}

/// Rows whose time since the last edge is short enough, and some more.
std::size_t keep_unsettled(StepRecord& record, double longest) {
  StepRecord kept{.file = record.file, .edges = record.edges};
  for (const Plateau& plateau : plateaus_of(record))
    for (std::size_t i = plateau.begin; i < plateau.end; ++i) {
      if (i >= plateau.begin + kFewestSettled && record.t[i] > record.t[plateau.begin] + longest) break;
      kept.t.push_back(record.t[i]);
      kept.Omega.push_back(record.Omega[i]);
      kept.delta.push_back(record.delta[i]);
    }
  const std::size_t left_out = record.rows() - kept.rows();
  record = std::move(kept);
  return left_out;
}

}  // namespace

std::vector<Plateau> plateaus_of(const StepRecord& record) {
  const auto row_at = [&](double t) {
    return static_cast<std::size_t>(std::ranges::lower_bound(record.t, t) - record.t.begin());
  };
  std::vector<Plateau> plateaus;
  for (std::size_t e = 0; e < record.edges.size(); ++e) {
    const std::size_t begin = e == 0 ? 0 : row_at(record.edges[e].t);
    const std::size_t end = e + 1 < record.edges.size() ? row_at(record.edges[e + 1].t) : record.rows();
    if (begin >= end) continue;
    const std::size_t middle = (begin + end) / 2;
    plateaus.push_back(
        {record.edges[e].delta, median({record.Omega.data() + middle, end - middle}), begin, end});
  }
  return plateaus;
}

std::size_t leave_out_settled_rows(std::vector<StepRecord>& records) {
  std::size_t rows = 0, left_out = 0;
  std::vector<double> arrivals;
  for (const StepRecord& record : records) {
    rows += record.rows();
    add_arrivals(record, arrivals);
  }
  if (rows <= kManyRows || arrivals.empty()) return 0;
  const double longest = kSettledAfter * median(arrivals);
  for (StepRecord& record : records) left_out += keep_unsettled(record, longest);
  return left_out;
}

}  // namespace ident
