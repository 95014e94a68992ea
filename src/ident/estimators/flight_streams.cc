// The shift at which changes over short windows agree best, with its spread over parts of the flight.
#include "ident/estimators/flight_streams.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/core/parallel.h"
#include "ident/estimators/flight_log_shift.h"
#include "ident/estimators/flight_motion.h"

namespace ident {
namespace {

constexpr double kLag = 0.12;         ///< s of a window: short, for time to show
constexpr double kShortTime = 0.03;   ///< s before and after over which an acceleration is taken
constexpr int kParts = 8;             ///< of the flight, for the spread
constexpr std::size_t kFewest = 200;  ///< windows to judge
constexpr double kAlike = 0.8;        ///< correlation of an axis that says anything
constexpr double kBeyondDoubt = 5.0;  ///< standard deviations
/// s of rates and of specific force that matter: turns about a lever arm look like some ms of the force.
constexpr double kShortestOfRates = 1e-3, kShortestOfForce = 8e-3;
constexpr double kOfAnInterval = 0.1;
constexpr double kLongestFilter =
    8e-3;  ///< s by which an autopilot's filters make the sensors of its IMU late

std::size_t half_width(const FlightArc& arc) {
  const double interval = (arc.t.back() - arc.t.front()) / static_cast<double>(arc.rows() - 1);
  return static_cast<std::size_t>(std::max(1.0, std::round(kShortTime / std::max(interval, 1e-6))));
}

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sums from which correlations over any parts are made: of the axes seen, of one told, of both.
struct Seen {
  double n = 0;
  Vector3d a = Vector3d::Zero();
  Matrix3d aa = Matrix3d::Zero();

  Seen& operator+=(const Seen& s) {
    n += s.n, a += s.a, aa += s.aa;
    return *this;
  }
};
struct Told {
  double b = 0, bb = 0;
  Vector3d ab = Vector3d::Zero();

  Told& operator+=(const Told& t) {
    b += t.b, bb += t.bb, ab += t.ab;
    return *this;
  }
};
using SeenParts = std::array<Seen, kParts>;
using ToldParts = std::vector<std::array<Told, kParts>>;  // of all axes

template <class Sum>
Sum sum_of(const std::array<Sum, kParts>& parts, int without) {
  Sum all;
  for (int part = 0; part < kParts; ++part)
    if (part != without) all += parts[static_cast<std::size_t>(part)];
  return all;
}

/// Share of what is told on an axis that the axes seen explain, one against another a little turned: a sensor
/// that is mounted askew would else look late. 0 where its own axis says the opposite.
double explained(const Seen& seen, const Told& told, Eigen::Index axis) {
  if (!(seen.n > 4)) return 0.0;
  Matrix3d A = seen.aa - seen.a * seen.a.transpose() / seen.n;
  const Vector3d c = told.ab - seen.a * (told.b / seen.n);
  const double yy = told.bb - told.b * told.b / seen.n;
  if (!(A(axis, axis) > 0) || !(yy > 0)) return 0.0;
  A.diagonal().array() += 1e-6 * A(axis, axis);  // an axis about which nothing turns
  const Vector3d x = A.ldlt().solve(c);
  return x[axis] > 0 ? std::clamp(x.dot(c) / yy, 0.0, 1 - 1e-12) : 0.0;
}

/// Shares of what is told by a shift that regressions on the axes seen leave, of the axes that agree.
std::vector<double> left(const SeenParts& seen, const ToldParts& told, const std::vector<bool>& alike,
                         int without) {
  std::vector<double> out;
  const Seen all = sum_of(seen, without);
  for (std::size_t k = 0; k < told.size(); ++k)
    if (alike[k]) out.push_back(1 - explained(all, sum_of(told[k], without), static_cast<Eigen::Index>(k)));
  return out;
}

/// Where the least is left, in shifts; NaN at an end. A small shift leaves a square of it: a parabola through
/// the likeliest shift and its neighbours, of the axes' shares in units of what it leaves of each.
double likeliest(const std::vector<std::vector<double>>& shifts) {
  const auto surprise = [](const std::vector<double>& shares) {
    double sum = 0;
    for (const double share : shares) sum += std::log(share);
    return sum;
  };
  const auto i = static_cast<std::size_t>(std::ranges::min_element(shifts, {}, surprise) - shifts.begin());
  if (i == 0 || i + 1 >= shifts.size()) return kNaN;
  double slope = 0, bend = 0;
  for (std::size_t k = 0; k < shifts[i].size(); ++k) {
    slope += 0.5 * (shifts[i + 1][k] - shifts[i - 1][k]) / shifts[i][k];
    bend += (shifts[i + 1][k] - 2 * shifts[i][k] + shifts[i - 1][k]) / shifts[i][k];
  }
  return static_cast<double>(i) - (bend > 0 ? slope / bend : 0.0);
}

/// The running integral of the size of the acceleration less gravity, as the velocity shows it, m/s. Sizes do
/// not ask for the attitude, which may be late itself.
Track sum_of_acceleration(const FlightArc& arc, double gravity) {
  const Track3 v = velocity_W(arc);
  const std::size_t rows = arc.rows(), half = half_width(arc);
  Track size(rows, gravity);
  for (std::size_t i = half; i + half < rows; ++i) {
    Eigen::Vector3d a(0, 0, -gravity);
    for (std::size_t k = 0; k < 3; ++k)
      a[static_cast<Eigen::Index>(k)] +=
          (v[k][i + half] - v[k][i - half]) / (arc.t[i + half] - arc.t[i - half]);
    size[i] = a.norm();
  }
  return integral(arc.t, size);
}

/// The same of the specific force, over the same short times.
Track sum_of_force(const FlightArc& arc) {
  const Track3 f = specific_force(arc);
  const Track3 sums = integrals(arc, f);
  const std::size_t rows = arc.rows(), half = half_width(arc);
  Track size(rows, 0.0);
  for (std::size_t i = half; i + half < rows; ++i) {
    Eigen::Vector3d mean;
    for (std::size_t k = 0; k < 3; ++k)
      mean[static_cast<Eigen::Index>(k)] =
          (sums[k][i + half] - sums[k][i - half]) / (arc.t[i + half] - arc.t[i - half]);
    size[i] = mean.norm();
  }
  return integral(arc.t, size);
}

struct Sides {
  std::vector<Track> seen, told;  ///< axes of running values whose changes should agree
};

/// How much later the told side is than the seen one.
StreamOffset offset_of(const std::vector<Sides>& arcs, double interval) {
  const ChangeWindows windows = change_windows(kLag, interval);
  const long step = std::max<long>(1, static_cast<long>(windows.margin) / 15);
  const long most = static_cast<long>(windows.margin) / step;
  const std::size_t axes_seen = arcs.empty() ? 0 : arcs[0].seen.size();
  std::vector<ToldParts> shifts(static_cast<std::size_t>(2 * most + 1), ToldParts(axes_seen));
  SeenParts seen;
  std::size_t count = 0, before = 0;
  std::vector<std::vector<Vector3d>> turned_of;
  for (const Sides& arc : arcs) {
    std::vector<Vector3d>& turned = turned_of.emplace_back();
    for (std::size_t k = 0; k < axes_seen; ++k) {
      const Track axis = changes(arc.seen[k], windows);
      turned.resize(axis.size(), Vector3d::Zero());
      for (std::size_t j = 0; j < axis.size(); ++j) turned[j][static_cast<Eigen::Index>(k)] = axis[j];
    }
    count += turned.size();
  }
  if (count < kFewest) return {};
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    const Sides& arc = arcs[a];
    const std::vector<Vector3d>& turned = turned_of[a];
    const auto part_of = [&](std::size_t j) { return (before + j) * kParts / count; };
    for (std::size_t j = 0; j < turned.size(); ++j) {
      Seen& part = seen[part_of(j)];
      part.n += 1, part.a += turned[j], part.aa += turned[j] * turned[j].transpose();
    }
    for (std::size_t k = 0; k < axes_seen; ++k) {
      const RunningSum sums(arc.told[k]);
      for (long s = -most; s <= most; ++s) {
        const Track told = changes(sums, windows, -s * step);
        for (std::size_t j = 0; j < turned.size(); ++j) {
          Told& part = shifts[static_cast<std::size_t>(s + most)][k][part_of(j)];
          part.b += told[j], part.bb += told[j] * told[j], part.ab += told[j] * turned[j];
        }
      }
    }
    before += turned.size();
  }
  std::vector<bool> alike(axes_seen, false);
  for (const ToldParts& axes : shifts)
    for (std::size_t k = 0; k < axes_seen; ++k)
      if (explained(sum_of(seen, -1), sum_of(axes[k], -1), static_cast<Eigen::Index>(k)) > kAlike * kAlike)
        alike[k] = true;
  if (std::ranges::none_of(alike, [](bool x) { return x; })) return {};
  const auto peak = [&](int without) {
    std::vector<std::vector<double>> shares;
    for (const ToldParts& axes : shifts) shares.push_back(left(seen, axes, alike, without));
    return (likeliest(shares) - static_cast<double>(most)) * static_cast<double>(step) * interval;
  };
  double square = 0;  // jackknife
  const double all = peak(-1);
  for (int part = 0; part < kParts; ++part) square += std::pow(peak(part) - all, 2);
  return {all, std::sqrt(square * (kParts - 1.0) / kParts)};
}

}  // namespace

bool StreamOffset::matters(double interval, double shortest) const {
  return std::abs(seconds) > kBeyondDoubt * std &&
         std::abs(seconds) > std::max(shortest, kOfAnInterval * interval);
}

StreamOffsets stream_offsets(const FlightRecord& record, double gravity) {
  const Signals& s = record.signals;
  const auto turns = [](const FlightArc& arc) {
    const auto all = [](const Track3& x) { return std::vector<Track>(x.begin(), x.end()); };
    return Sides{all(turn_of_attitude(arc)), all(turn_of_rates(arc))};
  };
  const auto forces = [&](const FlightArc& arc) {
    return Sides{{sum_of_acceleration(arc, gravity)}, {sum_of_force(arc)}};
  };
  const auto offset_by = [&](bool logged, const auto& sides_of) {
    std::vector<Sides> sides;
    for (const FlightArc& arc : record.arcs)
      if (logged && arc.rows() > 1) sides.push_back(sides_of(arc));
    return offset_of(sides, record.interval);
  };
  StreamOffsets found;
  in_parallel(2, [&](std::size_t which) {
    if (which == 0)
      found.rates = offset_by(s.rates && s.attitude, turns);
    else
      found.force = offset_by(s.force && s.velocity, forces);
  });
  return found;
}

std::vector<FlightLog> aligned_streams(const FlightRecord& record, std::span<const FlightLog> logs,
                                       double gravity, std::vector<Warning>& warnings) {
  const auto [rates, force_alone] = stream_offsets(record, gravity);
  const bool move_turns = rates.matters(record.interval, kShortestOfRates);
  // Late rates were filtered, and so was the specific force; what is later than that came by another way.
  const bool filtered = move_turns && rates.seconds > 0 && rates.seconds < kLongestFilter;
  const bool move_motion = move_turns && !filtered;
  StreamOffset force = force_alone;
  if (move_turns) force.seconds -= rates.seconds;
  const bool move_force = force.matters(record.interval, kShortestOfForce);
  if (!move_turns && !move_force) return {};
  std::vector<FlightLog> out(logs.begin(), logs.end());
  const auto tell = [&](const char* what, const char* against, const StreamOffset& o, const char* moved) {
    warnings.push_back(
        {"stream_offset", fmt::format("{} the same motion {} ms (± {}) {} than {}: {}read that much {}", what,
                                      format_number(1e3 * std::abs(o.seconds), 2),
                                      format_number(1e3 * o.std, 1), o.seconds > 0 ? "later" : "earlier",
                                      against, moved, o.seconds > 0 ? "earlier" : "later")});
  };
  const auto later = [](FlightLog& log, auto& columns, double seconds) {
    for (auto& column : columns) read_later(log.t, column, seconds);
  };
  const StreamOffset motion{-rates.seconds, rates.std};
  if (filtered) tell("the rates show", "the attitude", rates, "as filtered, with the specific force, ");
  if (move_motion) tell("attitude, velocity and position show", "the rates", motion, "");
  if (move_force) tell("the specific force shows", "the velocity", force, "");
  for (FlightLog& log : out) {
    if (filtered) later(log, log.w_B, rates.seconds), later(log, log.f_B, rates.seconds);
    if (move_motion) {
      read_attitude_later(log, motion.seconds);
      later(log, log.v_W, motion.seconds), later(log, log.x_W, motion.seconds);
    }
    if (move_force) later(log, log.f_B, force.seconds);
  }
  return out;
}

}  // namespace ident
