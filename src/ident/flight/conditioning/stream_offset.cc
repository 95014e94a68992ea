// The shift at which changes over short windows agree best, with its spread over parts of the flight.
#include "ident/flight/conditioning/stream_offset.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

constexpr int kParts = 8;                    ///< of the flight, for the spread
constexpr std::size_t kFewestShifted = 200;  ///< windows to judge
constexpr double kAlike = 0.8;               ///< correlation of an axis that says anything
constexpr double kOffsetBeyondDoubt = 5.0;   ///< standard deviations
constexpr double kOfAnInterval = 0.1;
constexpr long kSteps = 15;  ///< to either side

using Eigen::Index;
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
double explained(const Seen& seen, const Told& told, Index axis) {
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
    if (alike[k]) out.push_back(1 - explained(all, sum_of(told[k], without), static_cast<Index>(k)));
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

}  // namespace

bool StreamOffset::matters(double interval, double shortest) const {
  return std::abs(seconds) > kOffsetBeyondDoubt * std &&
         std::abs(seconds) > std::max(shortest, kOfAnInterval * interval);
}

namespace {

/// Changes seen, of all axes, by arc.
std::vector<std::vector<Vector3d>> changes_seen(const std::vector<StreamSides>& arcs,
                                                const ChangeWindows& windows) {
  std::vector<std::vector<Vector3d>> out;
  for (const StreamSides& arc : arcs) {
    std::vector<Vector3d>& turned = out.emplace_back();
    for (std::size_t k = 0; k < arc.seen.size(); ++k) {
      const Track axis = changes(arc.seen[k], windows);
      turned.resize(axis.size(), Vector3d::Zero());
      for (std::size_t j = 0; j < axis.size(); ++j) turned[j][static_cast<Index>(k)] = axis[j];
    }
  }
  return out;
}

/// Shifts that are tried, in rows.
struct Shifts {
  long from, step, count;
  long at(std::size_t i) const { return from + static_cast<long>(i) * step; }
};

/// The shift at which the sides agree best, rows; NaN where none does, or where that is the first or the
/// last. Spread by leaving out parts of the flight.
StreamOffset best_of(const std::vector<StreamSides>& arcs, const ChangeWindows& windows,
                     const Shifts& tried) {
  const std::size_t axes_seen = arcs.empty() ? 0 : arcs[0].seen.size();
  std::vector<ToldParts> shifts(static_cast<std::size_t>(tried.count), ToldParts(axes_seen));
  SeenParts seen;
  const std::vector<std::vector<Vector3d>> turned_of = changes_seen(arcs, windows);
  std::size_t count = 0, before = 0;
  for (const auto& turned : turned_of) count += turned.size();
  if (count < kFewestShifted) return {kNaN, kNaN};
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    const std::vector<Vector3d>& turned = turned_of[a];
    const auto part_of = [&](std::size_t j) { return (before + j) * kParts / count; };
    for (std::size_t j = 0; j < turned.size(); ++j) {
      Seen& part = seen[part_of(j)];
      part.n += 1, part.a += turned[j], part.aa += turned[j] * turned[j].transpose();
    }
    for (std::size_t k = 0; k < axes_seen; ++k) {
      const RunningSum sums(arcs[a].told[k]);
      for (std::size_t i = 0; i < shifts.size(); ++i) {
        const Track told = changes(sums, windows, -tried.at(i));
        for (std::size_t j = 0; j < turned.size(); ++j) {
          Told& part = shifts[i][k][part_of(j)];
          part.b += told[j], part.bb += told[j] * told[j], part.ab += told[j] * turned[j];
        }
      }
    }
    before += turned.size();
  }
  std::vector<bool> alike(axes_seen, false);
  for (const ToldParts& axes : shifts)
    for (std::size_t k = 0; k < axes_seen; ++k)
      if (explained(sum_of(seen, -1), sum_of(axes[k], -1), static_cast<Index>(k)) > kAlike * kAlike)
        alike[k] = true;
  if (std::ranges::none_of(alike, [](bool x) { return x; })) return {kNaN, kNaN};
  const auto peak = [&](int without) {
    std::vector<std::vector<double>> shares;
    for (const ToldParts& axes : shifts) shares.push_back(left(seen, axes, alike, without));
    return static_cast<double>(tried.from) + likeliest(shares) * static_cast<double>(tried.step);
  };
  double square = 0;  // jackknife
  const double all = peak(-1);
  for (int part = 0; part < kParts; ++part) square += std::pow(peak(part) - all, 2);
  return {all, std::sqrt(square * (kParts - 1.0) / kParts)};
}

/// Within so many rows about one.
StreamOffset best_about(const std::vector<StreamSides>& arcs, ChangeWindows windows, long middle,
                        long reach) {
  windows.margin = static_cast<std::size_t>(std::abs(middle) + reach);
  const long step = std::max(1L, reach / kSteps), most = reach / step;
  return best_of(arcs, windows, {middle - most * step, step, 2 * most + 1});
}

}  // namespace

StreamOffset offset_of(const std::vector<StreamSides>& arcs, double interval, double lag, double farthest) {
  const ChangeWindows windows = change_windows(lag, interval);
  const auto near = static_cast<long>(windows.margin);
  StreamOffset found = best_about(arcs, windows, 0, near);
  if (const auto far = std::lround(farthest / interval); !std::isfinite(found.seconds) && far > near)
    if (const StreamOffset rough = best_about(arcs, windows, -far / 2, far / 2); std::isfinite(rough.seconds))
      found = best_about(arcs, windows, std::lround(rough.seconds), near);
  if (!std::isfinite(found.seconds)) return {};
  return {found.seconds * interval, found.std * interval};
}

}  // namespace ident
