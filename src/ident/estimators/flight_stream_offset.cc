// The shift at which changes over short windows agree best, with its spread over parts of the flight.
#include "ident/estimators/flight_stream_offset.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

constexpr int kParts = 8;             ///< of the flight, for the spread
constexpr std::size_t kFewest = 200;  ///< windows to judge
constexpr double kAlike = 0.8;        ///< correlation of an axis that says anything
constexpr double kBeyondDoubt = 5.0;  ///< standard deviations
constexpr double kOfAnInterval = 0.1;

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

}  // namespace

bool StreamOffset::matters(double interval, double shortest) const {
  return std::abs(seconds) > kBeyondDoubt * std &&
         std::abs(seconds) > std::max(shortest, kOfAnInterval * interval);
}

StreamOffset offset_of(const std::vector<StreamSides>& arcs, double interval, double lag) {
  const ChangeWindows windows = change_windows(lag, interval);
  const long step = std::max<long>(1, static_cast<long>(windows.margin) / 15);
  const long most = static_cast<long>(windows.margin) / step;
  const std::size_t axes_seen = arcs.empty() ? 0 : arcs[0].seen.size();
  std::vector<ToldParts> shifts(static_cast<std::size_t>(2 * most + 1), ToldParts(axes_seen));
  SeenParts seen;
  std::size_t count = 0, before = 0;
  std::vector<std::vector<Vector3d>> turned_of;
  for (const StreamSides& arc : arcs) {
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
    const StreamSides& arc = arcs[a];
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

}  // namespace ident
