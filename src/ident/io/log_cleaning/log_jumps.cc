// A step from sample to sample against the steps before and after it.
#include "ident/io/log_cleaning/log_jumps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/io/log_cleaning/log_rows.h"

namespace ident {
namespace {

// Larger than so many of the usual deviations, and than so many times what all but a twentieth of the steps
// are: in a log that is slow against its flight what is usual says little of a turn.
constexpr double kUsual = 25.0, kMost = 6.0;
constexpr double kNormal = 1.4826;  // standard deviation over the median of sizes
constexpr double kUndone = 0.3;     // of a jump is left after the one back
constexpr double kExcursion = 1.0;  // s between them
constexpr double kOneGap = 3.0;     // times the usual step: samples further apart say nothing of each other
// More in one log are an estimator's way: only such as are so many times as large as they mostly are count.
constexpr std::size_t kMostJumps = 20;
constexpr double kOutstanding = 10.0;
constexpr std::size_t kFew = 50;

using Vector = std::array<double, 4>;

Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
double size_of(const Vector& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + a[3] * a[3]); }

struct Jump {
  std::size_t after = 0;  // place in the sampled rows
  Vector by{};
};

// Of the step after each sampled row, what the steps beside it do not lead to expect.
std::vector<Vector> unexpected(const FlightLog& log, Components sensor,
                               const std::vector<std::size_t>& rows) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < rows.size(); ++k) steps.push_back(log.t[rows[k]] - log.t[rows[k - 1]]);
  const double together = kOneGap * *middle_of(steps);
  std::vector<Vector> out(rows.size(), Vector{});
  for (std::size_t k = 1; k + 2 < rows.size(); ++k) {
    if (std::max({steps[k - 1], steps[k], steps[k + 1]}) > together) continue;
    for (std::size_t c = 0; c < sensor.size(); ++c) {
      const auto step = [&](std::size_t i) { return sensor[c][rows[i + 1]] - sensor[c][rows[i]]; };
      const double beside = 0.5 * (step(k - 1) / steps[k - 1] + step(k + 1) / steps[k + 1]);
      const double more = step(k) - steps[k] * beside;
      if (std::isfinite(more)) out[k][c] = more;
    }
  }
  return out;
}

// A jump shows in the steps beside it as well: of three in a row the largest is one.
std::vector<Jump> jumps_of(const std::vector<Vector>& more) {
  std::vector<double> sizes;
  for (const Vector& one : more) sizes.push_back(size_of(one));
  std::vector<double> sorted = sizes;
  const auto middle = sorted.begin() + std::ssize(sorted) / 2,
             high = sorted.begin() + std::ssize(sorted) * 19 / 20;
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double usual = kNormal * *middle;
  std::nth_element(middle, high, sorted.end());
  const double most = *high;
  std::vector<Jump> out;
  if (!(usual > 0)) return out;  // steps of a coarse sensor
  const double limit = std::max(kUsual * usual, kMost * most);
  for (std::size_t k = 1; k + 1 < more.size(); ++k)
    if (sizes[k] > limit && sizes[k] >= sizes[k - 1] && sizes[k] > sizes[k + 1]) out.push_back({k, more[k]});
  while (out.size() > kMostJumps) {
    std::vector<double> found;
    for (const Jump& jump : out) found.push_back(size_of(jump.by));
    const double least = kOutstanding * *middle_of(std::move(found));
    std::erase_if(out, [&](const Jump& jump) { return size_of(jump.by) < least; });
  }
  return out;
}

}  // namespace

void split_at_jumps(FlightLog& log, Components sensor, const std::string& name) {
  const std::vector<std::size_t> rows = rows_of(sensor);
  if (rows.size() < kFew) return;
  const std::vector<Jump> jumps = jumps_of(unexpected(log, sensor, rows));
  std::vector<Jump> lasting;
  std::size_t dropped = 0;
  double first_dropped = kNaN;
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    const std::size_t after = jumps[i].after;
    const bool undone = i + 1 < jumps.size() &&
                        size_of(jumps[i].by + jumps[i + 1].by) < kUndone * size_of(jumps[i].by) &&
                        log.t[rows[jumps[i + 1].after]] - log.t[rows[after]] < kExcursion;
    if (!undone) {
      lasting.push_back(jumps[i]);
      continue;
    }
    if (dropped == 0) first_dropped = log.t[rows[after + 1]];
    for (std::size_t k = after + 1; k <= jumps[i + 1].after; ++k, ++dropped)
      for (std::vector<double>& c : sensor) c[rows[k]] = kNaN;
    ++i;
  }
  if (dropped > 0)
    log.warnings.push_back({"spikes", fmt::format("{}: {}: jumps away and back within a second: {} samples "
                                                  "count as none, the first at t = {:.6g} s",
                                                  log.file, name, dropped, first_dropped)});
  for (const Jump& jump : lasting) log.breaks.push_back(log.t[rows[jump.after]]);
  std::ranges::sort(log.breaks);
  if (!lasting.empty())
    log.warnings.push_back(
        {"jumps", fmt::format("{}: {}: steps from one sample to the next as no vehicle moves. The flight is "
                              "split there ({} in all, first at t = {:.6g} s). Was the estimator reset?",
                              log.file, name, lasting.size(), log.t[rows[lasting[0].after]])});
}

}  // namespace ident
