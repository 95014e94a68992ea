// Increments of the smoothed accelerations against their own robust spread.
#include "ident/gap/statistics/bursts.h"

#include <algorithm>
#include <cmath>

#include "ident/core/stage_times.h"
#include "ident/core/statistics.h"
#include "ident/flight/fit/input_sensitivity.h"

namespace ident {
namespace {

constexpr double kBeyond = 6.0;  // standard deviations; the largest of 7000 calm jumps was at 4.2
// The same of moments where speeds are the input, of what gusts and their error make: those of motors that
// are driven between two samples of their speeds jumped by 7 of them, which shows in no force.
constexpr double kBeyondInput = 8.0;
constexpr double kSeen = 3.0;  // and as many of what one piece of flight tells of the rate or velocity
constexpr int kLeast = 30;     // jumps in a log, to know what is steady
// Where gusts act by a known drag their pushes go with the flight: what is steady is also judged by the jumps
// within so many seconds to either side.
constexpr double kNearby = 2.5;
constexpr std::size_t kNeighbours = 10;

struct Jump {
  double size, seen, t;  // seen: in standard deviations of the sensor over the piece
  double variance;       // that gusts and the error of measured speeds give it
  bool plain = true;     // is not what a sudden drive makes where speeds are the input
};

// What is expected of jumps differs along a flight where speeds are the input: all as if they were usual
// ones.
void make_alike(std::vector<Jump>& jumps, bool moments) {
  double mean = 0;
  for (const Jump& j : jumps) mean += j.variance / static_cast<double>(jumps.size());
  for (Jump& j : jumps) {
    j.plain = !moments || j.size > kBeyondInput * std::sqrt(j.variance);
    if (j.variance > 0) j.size *= std::sqrt(mean / j.variance);
  }
}

// Rows are missing there, and with them commands that nobody knows: what motors did meanwhile is no push.
bool has_hole(const FlightRecord& record, const ChunkPlace& place) {
  constexpr double kHole = 1.5;  // usual intervals
  const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
  for (std::size_t i = place.begin; i < place.end; ++i)
    if (arc.t[i + 1] - arc.t[i] > kHole * record.interval) return true;
  return false;
}

std::vector<Jump> jumps_of(const FlightRecord& record, const FlightFit& fit, int axis, int log) {
  const auto& places = fit.smoother->chunks();
  const auto& states = fit.smoother->states();
  std::vector<Jump> out;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(places[k].arc)];
    if (!places[k].linked || arc.log != log) continue;
    if (has_hole(record, places[k]) || has_hole(record, places[k + 1])) continue;
    const Disturbance<double>&a = states[k].outside, &b = states[k + 1].outside;
    const double size = axis < 3 ? b.w_dot_B[axis] - a.w_dot_B[axis] : b.v_dot[axis - 3] - a.v_dot[axis - 3];
    const double h = arc.t[places[k].end] - arc.t[places[k].begin],
                 rows = static_cast<double>(places[k].end - places[k].begin);
    const int channel = axis < 3 ? kGyro + axis : kVelocity + axis - 3;
    const double noise = fit.noise.sigma[static_cast<std::size_t>(channel)] / std::sqrt(rows);
    const AirNoise& air = fit.noise.in_log(log);
    const ColouredNoise& gusts =
        axis < 3 ? air.w_dot[static_cast<std::size_t>(axis)] : air.v_dot[static_cast<std::size_t>(axis - 3)];
    const double variance = 2 * gusts.sigma * gusts.sigma * (1 - gusts.carried(h)) +
                            fit.smoother->input_error(k, axis) + fit.smoother->input_error(k + 1, axis);
    out.push_back({std::abs(size), std::abs(size) * h / noise, arc.t[places[k].end], variance});
  }
  if (has_noisy_input(record)) make_alike(out, axis < 3);
  return out;
}

// Deviation of steady jumps about jump i, of those that are in order of time.
double spread_about(const std::vector<Jump>& jumps, std::size_t i, double overall) {
  std::vector<double> nearby;
  for (std::size_t k = 0; k < jumps.size(); ++k)
    if (k != i && std::abs(jumps[k].t - jumps[i].t) <= kNearby) nearby.push_back(jumps[k].size);
  if (nearby.size() < kNeighbours) return overall;
  return std::max(overall, 1.4826 * median(nearby));
}

}  // namespace

std::vector<Burst> bursts(const FlightRecord& record, const FlightFit& fit) {
  const Stage stage("what is left");
  static constexpr std::array names = {"Mx", "My", "Mz", "Fx", "Fy", "Fz"};
  std::vector<Burst> out;
  for (int axis = 0; axis < 6; ++axis) {
    if (axis < 3 ? record.layout.w_dot < 0 : record.layout.v_dot < 0) continue;
    for (int log = 0; log < record.logs; ++log) {
      const std::vector<Jump> jumps = jumps_of(record, fit, axis, log);
      if (jumps.size() < kLeast) continue;
      std::vector<double> sizes;
      for (const Jump& j : jumps) sizes.push_back(j.size);
      const double overall = 1.4826 * median(sizes);
      Burst found{.channel = names[static_cast<std::size_t>(axis)], .log = log};
      for (std::size_t i = 0; i < jumps.size(); ++i) {
        const Jump& j = jumps[i];
        if (!(j.size > kBeyond * overall && j.seen > kSeen)) continue;
        const double spread = spread_about(jumps, i, overall);
        if (!(j.size > kBeyond * spread)) continue;
        found.count += 1, found.plain += j.plain;
        if (const double beyond = j.size / std::max(spread, 1e-300); beyond > found.largest)
          found.largest = beyond, found.t = j.t;
      }
      if (found.count >= 2) out.push_back(found);
    }
  }
  std::ranges::sort(out, std::greater<>(), &Burst::largest);
  return out;
}

}  // namespace ident
