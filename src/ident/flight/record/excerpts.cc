// Parts of a record: held-out flight, excerpts, pieces of arcs.
#include "ident/flight/record/excerpts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ident {

FlightRecord without_arcs(const FlightRecord& record) {
  return {record.vehicle,
          {},
          record.logs,
          record.signals,
          record.layout,
          record.sigma,
          record.slow,
          record.interval,
          record.duration,
          record.motor_rate,
          record.turns_apart,
          record.warnings,
          record.p};
}

FlightState<double> FlightArc::start(std::size_t row) const {
  FlightState<double> out{};
  out.body = body[row];
  const std::size_t each = rotors();
  for (std::size_t n = 0; n < each; ++n) out.motors[n] = motors[row * each + n];
  return out;
}

FlightArc FlightArc::piece(std::size_t begin, std::size_t end) const {
  FlightArc out;
  out.log = log, out.stood = stood && begin == 0;
  const auto range = [&](const auto& v, std::size_t width) {
    return std::decay_t<decltype(v)>(v.begin() + static_cast<std::ptrdiff_t>(begin * width),
                                     v.begin() + static_cast<std::ptrdiff_t>(end * width));
  };
  out.t = range(t, 1), out.y = range(y, kChannels), out.q = range(q, 4), out.body = range(body, 1),
  out.motors = range(motors, rotors());
  out.inputs = inputs, out.rougher = rougher, out.speed_errors = speed_errors;
  return out;
}

double training_end(const FlightArc& arc, double training_share) {
  return arc.t.front() + training_share * (arc.t.back() - arc.t.front());
}

FlightRecord training_of(const FlightRecord& record, double training_share) {
  constexpr std::size_t kFewestRows = 8;
  FlightRecord out = without_arcs(record);
  for (const FlightArc& arc : record.arcs) {
    const auto cut = std::ranges::lower_bound(arc.t, training_end(arc, training_share)) - arc.t.begin();
    if (static_cast<std::size_t>(cut) >= kFewestRows)
      out.arcs.push_back(arc.piece(0, static_cast<std::size_t>(cut)));
  }
  return out;
}

FlightRecord held_out_of(const FlightRecord& record, double training_share) {
  FlightRecord held_out = without_arcs(record);
  held_out.duration = 0;
  for (const FlightArc& arc : record.arcs) {
    const double border = training_end(arc, training_share);
    const auto cut =
        static_cast<std::size_t>(std::lower_bound(arc.t.begin(), arc.t.end(), border) - arc.t.begin());
    if (arc.rows() - cut < 8) continue;
    held_out.arcs.push_back(arc.piece(cut, arc.rows()));
    held_out.duration += arc.t.back() - held_out.arcs.back().t.front();
  }
  return held_out;
}

FlightRecord excerpt_of(const FlightRecord& record, double share, double seconds) {
  FlightRecord excerpt = without_arcs(record);
  excerpt.duration = 0;
  const auto take = [&](const FlightArc& arc, std::size_t begin, std::size_t end) {
    if (end < begin + 8) return;
    excerpt.arcs.push_back(arc.piece(begin, end));
    excerpt.duration += arc.t[end - 1] - arc.t[begin];
  };
  // Of short arcs some are taken whole: the first of each log, and later ones as often as the share asks.
  std::vector<double> owed(static_cast<std::size_t>(record.logs), std::numeric_limits<double>::infinity());
  for (const FlightArc& arc : record.arcs) {
    const double first = arc.t.front(), length = arc.t.back() - first;
    if (share * length < 0.5 * seconds) {
      double& now = owed[static_cast<std::size_t>(arc.log)];
      const bool whole = (now += share * length) >= length;
      if (whole) now = std::isfinite(now) ? now - length : 0.0, take(arc, 0, arc.rows());
      continue;
    }
    const auto stretches = std::max(1L, std::lround(share * length / seconds));
    const double every = length / static_cast<double>(stretches);
    const auto row_at = [&](double t) {
      return static_cast<std::size_t>(std::lower_bound(arc.t.begin(), arc.t.end(), t) - arc.t.begin());
    };
    for (long i = 0; i < stretches; ++i) {
      const double middle = first + (static_cast<double>(i) + 0.5) * every;
      take(arc, row_at(middle - 0.5 * share * every), row_at(middle + 0.5 * share * every));
    }
  }
  return excerpt;
}

}  // namespace ident
