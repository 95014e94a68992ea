// Increments of the smoothed accelerations against their own robust spread.
#include "ident/gap/bursts.h"

#include <algorithm>
#include <cmath>

namespace ident {
namespace {

constexpr double kBeyond = 6.0;  // standard deviations; the largest of 7000 calm jumps was at 4.2
constexpr double kSeen = 3.0;    // and as many of what one piece of flight tells of the rate or velocity
constexpr int kLeast = 30;       // jumps in a log, to know what is steady

struct Jump {
  double size, seen, t;  // seen: in standard deviations of the sensor over the piece
};

std::vector<Jump> jumps_of(const FlightRecord& record, const FlightFit& fit, int axis, int log) {
  const auto& places = fit.smoother->chunks();
  const auto& states = fit.smoother->states();
  std::vector<Jump> out;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(places[k].arc)];
    if (!places[k].linked || arc.log != log) continue;
    const Disturbance<double>&a = states[k].outside, &b = states[k + 1].outside;
    const double size = axis < 3 ? b.w_dot_B[axis] - a.w_dot_B[axis] : b.v_dot[axis - 3] - a.v_dot[axis - 3];
    const double h = arc.t[places[k].end] - arc.t[places[k].begin],
                 rows = static_cast<double>(places[k].end - places[k].begin);
    const int channel = axis < 3 ? kGyro + axis : kVelocity + axis - 3;
    const double noise = fit.noise.sigma[static_cast<std::size_t>(channel)] / std::sqrt(rows);
    out.push_back({std::abs(size), std::abs(size) * h / noise, arc.t[places[k].end]});
  }
  return out;
}

}  // namespace

std::vector<Burst> bursts(const FlightRecord& record, const FlightFit& fit) {
  static constexpr std::array names = {"Mx", "My", "Mz", "Fx", "Fy", "Fz"};
  std::vector<Burst> out;
  for (int axis = 0; axis < 6; ++axis) {
    if (axis < 3 ? record.layout.w_dot < 0 : record.layout.v_dot < 0) continue;
    for (int log = 0; log < record.logs; ++log) {
      std::vector<Jump> jumps = jumps_of(record, fit, axis, log);
      if (jumps.size() < kLeast) continue;
      std::ranges::sort(jumps, {}, &Jump::size);
      const double spread = 1.4826 * jumps[jumps.size() / 2].size;
      const auto count = std::ranges::count_if(
          jumps, [&](const Jump& j) { return j.size > kBeyond * spread && j.seen > kSeen; });
      if (count >= 2)
        out.push_back({names[static_cast<std::size_t>(axis)], log, static_cast<int>(count),
                       jumps.back().size / std::max(spread, 1e-300), jumps.back().t});
    }
  }
  std::ranges::sort(out, std::greater<>(), &Burst::largest);
  return out;
}

}  // namespace ident
