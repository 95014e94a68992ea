// Makes steady points of rows, and turns the sign where the file shows forces negative.
#include "ident/bench/thrust/thrust_sweep_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/bench/thrust/thrust_sweep_lag.h"
#include "ident/bench/thrust/thrust_sweep_tare.h"
#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr std::size_t kMostRawPoints = 3000;  // beyond it rows of a set-point are averaged as in a log
constexpr std::size_t kMostSetPoints =
    80;  // with a speed of their own each: cost grows with the square of their number
constexpr std::size_t kMostStretchesPoints = 100;  // of a ramp in a table
constexpr std::size_t kFewestInADwell = 3;
constexpr std::size_t kFewestPoints = 3;
constexpr std::size_t kFewestDwells = 4;

/// Median of the slopes of y over Omega^2 between points that are far apart, and of what is left at zero.
void rough_line(SweepChannel& channel) {
  std::vector<SweepPoint> sorted = channel.moving;
  std::ranges::sort(sorted, {}, &SweepPoint::Omega);
  std::vector<double> slopes, left;
  const std::size_t n = sorted.size(), half = std::max<std::size_t>(1, n / 2);
  for (std::size_t i = 0; i + half < n; ++i) {
    const double run = square(sorted[i + half].Omega) - square(sorted[i].Omega);
    if (run > 0.0) slopes.push_back((sorted[i + half].value - sorted[i].value) / run);
  }
  channel.start_constant = slopes.empty() ? kNaN : median(slopes);
  for (const SweepPoint& p : sorted) left.push_back(p.value - channel.start_constant * square(p.Omega));
  channel.start_tare = std::isfinite(channel.rest_mean) ? channel.rest_mean
                       : channel.rest.empty()           ? median(left)
                                                        : median(channel.rest);
}

void turn_round(SweepChannel& channel) {
  if (!(channel.start_constant < 0.0)) return;
  channel.reversed = true;
  for (SweepPoint& p : channel.moving) p.value = -p.value;
  for (double& v : channel.rest) v = -v;
  channel.rest_mean = -channel.rest_mean;
  channel.start_constant = -channel.start_constant;
  channel.start_tare = -channel.start_tare;
}

/// Every row a point.
void take_rows(const SweepRows& rows, const std::vector<double>& y, SweepChannel& channel) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(y[i]) || !std::isfinite(rows.Omega[i])) continue;
    if (rows.at_rest[i]) {
      channel.rest.push_back(y[i]);
      channel.rest_place.push_back(rows.place[i]);
    } else {
      channel.moving.push_back({rows.Omega[i], y[i], rows.place[i], rows.set_point[i]});
    }
  }
  channel.used = channel.moving.size() + channel.rest.size();
}

/// Every set-point a point: robust mean of the force, speed over the same rows. Returns the stays at rest.
std::vector<RestStay> take_dwells(const SweepRows& rows, const std::vector<double>& y,
                                  SweepChannel& channel) {
  std::vector<double> values, speeds, places;
  std::vector<RestStay> stays;
  const auto close = [&](int set_point, bool at_rest) {
    if (values.size() >= kFewestInADwell) {
      const RobustMean found = robust_mean(values);
      channel.used += found.used;
      if (at_rest) {
        stays.push_back(rest_stay(mean(places), values));
        channel.rest.push_back(found.value);
        channel.rest_place.push_back(mean(places));
      } else {
        channel.moving.push_back({robust_mean(speeds).value, found.value, mean(places), set_point});
      }
    }
    values.clear(), speeds.clear(), places.clear();
  };
  int current = -1;
  bool rest = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows.set_point[i] < 0 && (rows.is_log || !rows.at_rest[i])) continue;
    if (rows.set_point[i] != current || rows.at_rest[i] != rest) {
      close(current, rest);
      current = rows.set_point[i], rest = rows.at_rest[i];
    }
    if (!std::isfinite(y[i]) || !std::isfinite(rows.Omega[i])) continue;
    values.push_back(y[i]), speeds.push_back(rows.Omega[i]), places.push_back(rows.place[i]);
  }
  close(current, rest);
  return stays;
}

/// Rows of a ramp, every few of them a point: the mean of the force over the mean of the squared speed, on
/// which (1) is a line. Noise of the speed adds its variance to all squares alike, so that it reaches the
/// tare and not the slope. Returns the stays at rest.
std::vector<RestStay> take_stretches(const SweepRows& rows, const std::vector<double>& y,
                                     SweepChannel& channel) {
  std::vector<std::size_t> moving;
  std::vector<RestStay> stays;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<double> rest, rest_places;
    for (; i < rows.size() && rows.at_rest[i]; ++i)
      if (std::isfinite(y[i])) rest.push_back(y[i]), rest_places.push_back(rows.place[i]);
    if (rest.size() >= kFewestInADwell) {
      stays.push_back(rest_stay(mean(rest_places), rest));
      channel.rest.push_back(stays.back().value);
      channel.rest_place.push_back(stays.back().place);
      channel.used += rest.size();
    }
    if (i < rows.size() && std::isfinite(y[i]) && std::isfinite(rows.Omega[i])) moving.push_back(i);
  }
  const std::size_t length = std::max(kFewestInADwell, moving.size() / kMostStretchesPoints);
  for (std::size_t begin = 0; begin + length <= moving.size(); begin += length) {
    std::vector<double> values, squares, places;
    for (std::size_t k = begin; k < begin + length; ++k) {
      values.push_back(y[moving[k]]);
      squares.push_back(square(rows.Omega[moving[k]]));
      places.push_back(rows.place[moving[k]]);
    }
    const RobustMean found = robust_mean(values);
    channel.moving.push_back({std::sqrt(mean(squares)), found.value, mean(places), -1});
  }
  channel.used += channel.moving.size() * length;
  return stays;
}

/// The level of the tare from the stays at rest of a log; its drift is taken off the points.
void take_tare(const std::vector<RestStay>& stays, SweepChannel& channel) {
  if (stays.empty()) return;
  const TareDrift tare(stays);
  channel.rest_mean = tare.mean();
  channel.rest_std = tare.std();
  channel.drifts = tare.drifts();
  for (SweepPoint& p : channel.moving) p.value -= tare.deviation(p.place);
}

SweepChannel channel_of(const SweepRows& rows, const std::vector<double>& y, std::string name,
                        std::string unit, SweepPoints& points) {
  SweepChannel channel{.name = std::move(name), .unit = std::move(unit)};
  if (y.empty()) return channel;
  for (std::size_t i = 0; i < y.size(); ++i)
    channel.rows += std::isfinite(y[i]) && std::isfinite(rows.Omega[i]);
  std::vector<RestStay> stays;
  if (points.ramp)
    stays = take_stretches(rows, y, channel);
  else if (points.averaged)
    stays = take_dwells(rows, y, channel);
  else
    take_rows(rows, y, channel);
  if (rows.is_log && channel.moving.size() < kFewestDwells) {
    const LaggedPoints lagged = lagged_points(rows, y);
    if (lagged.points.size() > channel.moving.size()) {
      channel.moving = lagged.points;
      points.lag = lagged.lag;
    }
  }
  if (channel.moving.size() < 2) {
    channel.moving.clear();
    return channel;
  }
  take_tare(stays, channel);
  rough_line(channel);
  turn_round(channel);
  return channel;
}

/// Is there more than one reading, to a millionth?
bool changes(const SweepChannel& channel) {
  double low = channel.moving[0].value, high = low;
  for (const SweepPoint& p : channel.moving) low = std::min(low, p.value), high = std::max(high, p.value);
  for (const double v : channel.rest) low = std::min(low, v), high = std::max(high, v);
  return high - low > 1e-6 * std::max(std::fabs(low), std::fabs(high));
}

/// Squared speeds that differ by 5 % at least, rest included.
bool has_range(const SweepChannel& channel) {
  const auto [low, high] = std::ranges::minmax(channel.moving, {}, &SweepPoint::Omega);
  return !channel.rest.empty() || square(low.Omega) < 0.95 * square(high.Omega);
}

void expect_thrust(const SweepChannel& thrust, const std::string& file) {
  if (thrust.moving.size() < kFewestPoints)
    throw DataError(
        fmt::format("{}: only {} steady points with thrust and rotor speed: kT needs at least {} at "
                    "different speeds",
                    file, thrust.moving.size(), kFewestPoints));
  if (!has_range(thrust))
    throw DataError(file +
                    ": all rows were taken at one rotor speed and none at rest: kT needs thrust at "
                    "different speeds");
  if (!changes(thrust) || !std::isfinite(thrust.start_constant))
    throw DataError(file +
                    ": thrust is the same in every row: the column is not that of a force that was "
                    "measured");
}

}  // namespace

double SweepChannel::full_scale() const {
  constexpr double kGross = 2.0;  // times what the rough law says: a slip of the pen, no scale
  double top = 0.0, any = 0.0;
  for (const SweepPoint& p : moving) {
    const double value = std::fabs(p.value - start_tare);
    any = std::max(any, value);
    if (value <= kGross * std::fabs(start_constant) * p.Omega * p.Omega) top = std::max(top, value);
  }
  return top > 0 ? top : any;
}

SweepPoints sweep_points(const SweepRows& rows) {
  SweepPoints points;
  std::size_t moving = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) moving += std::isfinite(rows.Omega[i]) && !rows.at_rest[i];
  const auto set_points = static_cast<std::size_t>(rows.set_points);
  const bool repeated = set_points * kFewestInADwell < rows.size(), alone = moving == set_points;
  const bool many = rows.size() > kMostRawPoints || (set_points > kMostSetPoints && !alone);
  points.ramp = many && !repeated && !rows.is_log;
  points.averaged = rows.is_log || many;
  points.thrust = channel_of(rows, rows.thrust, "thrust", "N", points);
  points.torque = channel_of(rows, rows.torque, "torque", "N m", points);
  expect_thrust(points.thrust, rows.file);
  if (points.torque.moving.size() < kFewestPoints || !std::isfinite(points.torque.start_constant) ||
      !changes(points.torque) || !has_range(points.torque))
    points.torque.moving.clear();
  return points;
}

}  // namespace ident
