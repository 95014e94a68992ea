// Finds rows in which the motor is not driven, and makes records without them.
#include "ident/bench/motor/motor_step_undriven.h"

#include <algorithm>

#include "ident/bench/motor/motor_step_plateaus.h"

namespace ident {
namespace {

constexpr double kStanding = 0.02;  // of the greatest speed: slower than this no motor runs under control
constexpr double kReached = 0.98;   // of the new level
constexpr std::size_t kFewestCoastingRows = 12, kApproachRows = 10;

/// First row of a plateau at its level, coming from below; its end when it never gets there.
std::size_t reached(const StepRecord& record, const Plateau& plateau) {
  for (std::size_t i = plateau.begin; i < plateau.end; ++i)
    if (record.Omega[i] >= kReached * plateau.level) return i;
  return plateau.end;
}

/// Rows [begin, end) as a record of their own.
StepRecord part(const StepRecord& record, std::size_t begin, std::size_t end) {
  const auto cut = [&](const std::vector<double>& v) {
    return std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(begin),
                               v.begin() + static_cast<std::ptrdiff_t>(end));
  };
  StepRecord result{record.file, cut(record.t), cut(record.Omega), cut(record.delta), {}};
  for (const CommandEdge& edge : record.edges) {
    if (edge.t > result.t.back()) break;
    if (edge.t <= result.t.front()) result.edges.clear();
    result.edges.push_back(edge);
  }
  result.edges.front().down = false;
  return result;
}

}  // namespace

std::vector<UndrivenStretch> undriven_stretches(const std::vector<StepRecord>& records) {
  using Kind = UndrivenStretch::Kind;
  std::vector<UndrivenStretch> stretches;
  double fastest = 0.0;
  for (const StepRecord& record : records)
    for (const double Omega : record.Omega) fastest = std::max(fastest, Omega);
  for (std::size_t k = 0; k < records.size(); ++k) {
    bool before = false;  // was the motor off on the plateau before?
    for (const Plateau& plateau : plateaus_of(records[k])) {
      const bool off = plateau.delta <= 0.0 || plateau.level < kStanding * fastest;
      if (off)
        stretches.push_back({Kind::coasting, k, plateau.begin, plateau.end});
      else if (before)
        stretches.push_back({Kind::from_rest, k, plateau.begin, reached(records[k], plateau)});
      before = off;
    }
  }
  return stretches;
}

std::vector<StepRecord> without(const std::vector<StepRecord>& records,
                                const std::vector<UndrivenStretch>& stretches) {
  std::vector<StepRecord> left;
  for (std::size_t k = 0; k < records.size(); ++k) {
    std::size_t begin = 0;
    const auto keep_to = [&](std::size_t end) {
      if (end >= begin + kFewestCoastingRows) left.push_back(part(records[k], begin, end));
    };
    for (const UndrivenStretch& stretch : stretches) {
      if (stretch.record != k) continue;
      keep_to(stretch.begin);
      begin = stretch.end;
    }
    keep_to(records[k].rows());
  }
  return left;
}

StepRecord with_approach(const std::vector<StepRecord>& records, const UndrivenStretch& stretch) {
  const std::size_t begin = stretch.begin > kApproachRows ? stretch.begin - kApproachRows : 0;
  return part(records[stretch.record], begin, stretch.end);
}

bool has_edges(const std::vector<StepRecord>& records) {
  return std::ranges::any_of(records, [](const StepRecord& r) { return r.edges.size() > 1; });
}

}  // namespace ident
