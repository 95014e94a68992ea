// Attitude by integration where it is missing, and the integral of what acts beside gravity.
#include "ident/flight/ladder/measured_motion.h"

#include <algorithm>
#include <cmath>

#include "ident/flight/record/initial_states.h"

namespace ident {
namespace {

constexpr double kRow = 0.01;  // s: motion below some 10 Hz is what windows of a tenth of a second show

// Turned from one row to the next by the mean of the rates at both.
void turn_by_rates(std::vector<BodyState<double>>& body, const std::vector<double>& t) {
  for (std::size_t i = 0; i + 1 < body.size(); ++i) {
    const Vec3<double> turn = 0.5 * (t[i + 1] - t[i]) * (body[i].w_B + body[i + 1].w_B);
    const double angle = turn.norm(), half = angle > 1e-12 ? std::sin(angle / 2) / angle : 0.5;
    const Vec4<double> step(std::cos(angle / 2), half * turn[0], half * turn[1], half * turn[2]);
    body[i + 1].q_WB = quaternion_product(body[i].q_WB, step).normalized();
  }
}

std::vector<Vec3<double>> integral_of_force(const FlightArc& arc,
                                            const std::vector<BodyState<double>>& body) {
  std::array<std::vector<double>, 3> f;
  for (int k = 0; k < 3; ++k) f[static_cast<std::size_t>(k)] = filled_column(arc, kForce + k);
  std::vector<Vec3<double>> sum(arc.rows(), Vec3<double>::Zero());
  if (f[0].empty() || f[1].empty() || f[2].empty()) return {};
  Vec3<double> before;
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    const Vec3<double> now = rotation(body[i].q_WB) * Vec3<double>(f[0][i], f[1][i], f[2][i]);
    if (i > 0) sum[i] = sum[i - 1] + 0.5 * (arc.t[i] - arc.t[i - 1]) * (before + now);
    before = now;
  }
  return sum;
}

// Rows kRow apart, as near as there are: streams with times of their own make rows that are closer by far.
std::vector<std::size_t> rows_looked_at(const std::vector<double>& t) {
  constexpr double kAlike = 1e-6;  // s
  std::vector<std::size_t> rows{0};
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double next = t[rows.back()] + kRow;
    const bool nearer_follows =
        i + 1 < t.size() && std::abs(t[i + 1] - next) <= std::abs(t[i] - next) + kAlike;
    if (t[i] >= next - kRow / 2 && !nearer_follows) rows.push_back(i);
  }
  return rows;
}

template <class T>
std::vector<T> at_rows(const std::vector<T>& all, const std::vector<std::size_t>& rows) {
  std::vector<T> some;
  some.reserve(rows.size());
  for (const std::size_t i : rows) some.push_back(all[i]);
  return some;
}

void thin_out(MeasuredArc& measured) {
  measured.row = rows_looked_at(measured.arc->t);
  measured.t = at_rows(measured.arc->t, measured.row);
  measured.body = at_rows(measured.body, measured.row);
  if (!measured.gained_W.empty()) measured.gained_W = at_rows(measured.gained_W, measured.row);
}

}  // namespace

MeasuredMotion measured_motion(const FlightRecord& record) {
  const Signals& logged = record.signals;
  MeasuredMotion motion{.record = &record};
  motion.moments = logged.rates || logged.attitude;
  motion.velocity = logged.attitude && (logged.velocity || logged.position);
  motion.forces = motion.moments && (motion.velocity || logged.force);
  motion.speeds = logged.commands && logged.rotor_speeds;
  for (const FlightArc& arc : record.arcs) {
    MeasuredArc measured{.arc = &arc, .body = arc.body};
    if (!logged.attitude) turn_by_rates(measured.body, arc.t);
    if (motion.velocity) {
      for (std::size_t i = 0; i < arc.rows(); ++i) {
        Vec3<double> v = arc.body[i].v_W;
        v[2] -= record.vehicle->g * (arc.t[i] - arc.t[0]);
        measured.gained_W.push_back(v);
      }
    } else if (motion.forces) {
      measured.gained_W = integral_of_force(arc, measured.body);
    }
    if (motion.forces && measured.gained_W.empty()) continue;
    thin_out(measured);
    motion.arcs.push_back(std::move(measured));
  }
  return motion;
}

double typical_row(const MeasuredMotion& motion) { return std::max(kRow, motion.record->interval); }

std::vector<Window> windows_of(const MeasuredMotion& motion, double horizon, double spacing) {
  std::vector<Window> all;
  for (std::size_t a = 0; a < motion.arcs.size(); ++a) {
    const std::vector<double>& t = motion.arcs[a].t;
    const double early = 0.5 * typical_row(motion);
    std::size_t begin = 0, end = 0;
    for (double from = t.front(); from + horizon <= t.back() + early; from += spacing) {
      while (t[begin] < from - 1e-9) ++begin;
      while (end + 1 < t.size() && t[end] < t[begin] + horizon - early) ++end;
      if (t[end] < t[begin] + horizon - early || end <= begin) break;
      double speed = 0;
      for (std::size_t i = begin; i <= end; ++i) speed += motion.arcs[a].body[i].v_W.norm();
      all.push_back({a, begin, end, t[begin], speed / static_cast<double>(end + 1 - begin)});
    }
  }
  return all;
}

}  // namespace ident
