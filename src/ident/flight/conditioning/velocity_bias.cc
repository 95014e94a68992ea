// Slopes of position less integrated velocity over blocks of time: their mean, and by their scatter whether
// it is one. Positions that drift scatter too.
#include "ident/flight/conditioning/velocity_bias.h"

#include <fmt/format.h>

#include <cmath>

#include "ident/core/format_number.h"
#include "ident/flight/conditioning/dead_reckoning_error.h"

namespace ident {
namespace {

using Eigen::Array3d;

constexpr double kShortest = 1.0, kLongestBlock = 5.0;  // blocks, s
constexpr double kBlocks = 8.0;                         // of a log that is too short for such long ones
constexpr std::size_t kFewBlocks = 6, kFewSamples = 4;
constexpr double kBiasBeyondDoubt = 5.0;  // standard deviations of the mean

// Slope of a line through values over time.
struct BlockLine {
  double n = 0, t = 0, tt = 0;
  Array3d y = Array3d::Zero(), ty = Array3d::Zero();

  void add(double at, const Array3d& value) { n += 1, t += at, tt += at * at, y += value, ty += at * value; }
  Array3d slope() const { return (ty - y * (t / n)) / (tt - t * t / n); }
};

// What integrated velocities gain on positions in each block, m/s.
void add_blocks(const FlightArc& arc, double seconds, std::vector<Array3d>& blocks) {
  Array3d path = Array3d::Zero(), last = Array3d::Constant(kNaN);
  double t_last = 0, begin = kNaN;
  BlockLine line;
  const auto close = [&](double t) {
    if (line.n >= kFewSamples && t - begin > 0.8 * seconds) blocks.push_back(-line.slope());
    line = {}, begin = t;
  };
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    const double t = arc.t[i];
    const Array3d v = group_at(arc, i, kVelocity), x = group_at(arc, i, kPosition);
    if (v.allFinite()) {
      if (last.allFinite()) path += 0.5 * (t - t_last) * (v + last);
      if (!last.allFinite()) begin = t;
      last = v, t_last = t;
    }
    if (!last.allFinite() || !x.allFinite()) continue;
    if (t - begin >= seconds) close(t);
    line.add(t - begin, x - path - (t - t_last) * last);
  }
  if (std::isfinite(begin)) close(arc.t.back());
}

}  // namespace

void take_out_velocity_bias(FlightRecord& record) {
  if (!record.signals.velocity || !record.signals.position) return;
  for (int log = 0; log < record.logs; ++log) {
    double duration = 0;
    for (const FlightArc& arc : record.arcs)
      if (arc.log == log) duration += arc.t.back() - arc.t.front();
    std::vector<Array3d> blocks;
    for (const FlightArc& arc : record.arcs)
      if (arc.log == log) add_blocks(arc, std::clamp(duration / kBlocks, kShortest, kLongestBlock), blocks);
    if (blocks.size() < kFewBlocks) continue;
    const double n = static_cast<double>(blocks.size());
    Array3d mean = Array3d::Zero(), square = Array3d::Zero();
    for (const Array3d& one : blocks) mean += one / n;
    for (const Array3d& one : blocks) square += (one - mean).square() / (n - 1);
    const Array3d doubt = kBiasBeyondDoubt * (square / n).sqrt();
    if (!(mean.abs() > doubt).any()) continue;
    const Array3d bias = (mean.abs() > doubt).select(mean, 0.0);
    for (FlightArc& arc : record.arcs)
      for (std::size_t i = 0; arc.log == log && i < arc.rows(); ++i)
        for (int k = 0; k < 3; ++k) arc.y[i * kChannels + static_cast<std::size_t>(kVelocity + k)] -= bias[k];
    record.warnings.push_back(
        {"velocity_bias",
         fmt::format("log {}: velocities are off by ({}, {}, {}) m/s against the path, which was taken out",
                     log + 1, format_number(bias[0]), format_number(bias[1]), format_number(bias[2]))});
  }
}

}  // namespace ident
