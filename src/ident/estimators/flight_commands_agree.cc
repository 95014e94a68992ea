// Regression of each speed on commands that pass a dead time and a first-order lag, over a coarse grid of
// both.
#include "ident/estimators/flight_commands_agree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "ident/core/math.h"
#include "ident/estimators/statistics.h"

namespace ident {
namespace {

constexpr std::array kLags = {0.05, 0.02, 0.12, 0.25};     // s
constexpr std::array kDeadTimes = {0.0, 0.03, 0.08, 0.2};  // s
// Share of the variance within short stretches that is explained: with the nearest of these by right commands
// 0.97 and more of simulated flights, by the sign of these alone up to 0.77. What a battery does is slower.
constexpr double kFollows = 0.85;
constexpr double kStretch = 3.0;  // s
// A speed that changes there by fewer of its own noise, or by a smaller share of its mean, tells nothing.
constexpr double kChanges = 5.0, kOfMean = 0.01;
constexpr double kFlies = 0.3;  // of the median speed: slower ones are of the ground
constexpr std::size_t kLeast = 200;

struct Speed {
  std::vector<std::size_t> rows;  // that brought a new value in flight
  std::vector<double> Omega;
};

bool is_used(const FlightLog& log, double t) {
  return log.windows.empty() ||
         std::ranges::any_of(log.windows, [&](const auto& w) { return t >= w[0] && t <= w[1]; });
}

// Sums of squares and products about the means of stretches.
struct Within {
  double xx = 0, xy = 0, yy = 0;
};
Within within_stretches(const FlightLog& log, const Speed& speed, const std::vector<double>& by) {
  Within all;
  double n = 0, x = 0, y = 0, begin = -1e300;
  Within here;
  const auto close = [&] {
    if (n > 0) all.xx += here.xx - x * x / n, all.xy += here.xy - x * y / n, all.yy += here.yy - y * y / n;
    n = x = y = 0, here = {};
  };
  for (std::size_t k = 0; k < speed.rows.size(); ++k) {
    const double a = by[speed.rows[k]], b = speed.Omega[k], t = log.t[speed.rows[k]];
    if (!std::isfinite(a)) continue;
    if (t - begin > kStretch) close(), begin = t;
    n += 1, x += a, y += b, here.xx += a * a, here.xy += a * b, here.yy += b * b;
  }
  close();
  return all;
}

// The samples of a rotor's speed in flight; none where they tell nothing. Speeds that are held between
// samples count once.
std::optional<Speed> telling(const FlightLog& log, const std::vector<double>& column) {
  std::vector<double> turning;
  std::ranges::copy_if(column, std::back_inserter(turning), [](double x) { return x > 0; });
  if (turning.size() < kLeast) return {};
  const double slowest = kFlies * median(turning);
  Speed speed;
  for (std::size_t i = 0; i < column.size(); ++i) {
    const bool anew = speed.Omega.empty() || column[i] != speed.Omega.back();
    if (column[i] > slowest && anew && is_used(log, log.t[i]))
      speed.rows.push_back(i), speed.Omega.push_back(column[i]);
  }
  if (speed.rows.size() < kLeast) return {};
  std::vector<double> changes;
  for (std::size_t i = 1; i < speed.Omega.size(); ++i) changes.push_back(speed.Omega[i] - speed.Omega[i - 1]);
  const double noise = mad_scale(changes, 0.0) / std::sqrt(2.0);
  const double spread =
      std::sqrt(within_stretches(log, speed, column).yy / static_cast<double>(speed.rows.size()));
  if (!(spread > kChanges * noise) || !(spread > kOfMean * mean(speed.Omega))) return {};
  return speed;
}

// A column of commands after a dead time and a lag; rows without a command hold the last one.
std::vector<double> lagged(const std::vector<double>& t, const std::vector<double>& delta, double dead_time,
                           double lag) {
  std::vector<double> out(t.size(), kNaN);
  double y = kNaN, command = kNaN;
  std::size_t next = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (i > 0) y += (1 - std::exp(-(t[i] - t[i - 1]) / lag)) * (command - y);
    for (; next <= i && t[next] <= t[i] - dead_time; ++next)
      if (std::isfinite(delta[next])) command = delta[next];
    if (!std::isfinite(y)) y = command;
    out[i] = y;
  }
  return out;
}

bool follows(const FlightLog& log, const Speed& speed, const std::vector<double>& delta) {
  for (const double dead_time : kDeadTimes)
    for (const double lag : kLags)
      if (const Within sums = within_stretches(log, speed, lagged(log.t, delta, dead_time, lag));
          sums.xy > 0 && sums.xy * sums.xy > kFollows * sums.xx * sums.yy)
        return true;
  return false;
}

}  // namespace

bool commands_contradict_speeds(const FlightLog& log) {
  bool told = false;
  for (std::size_t n = 0; n < log.Omega.size(); ++n) {
    const std::optional<Speed> speed = telling(log, log.Omega[n]);
    if (!speed) continue;
    for (std::size_t i = 0; i < log.delta.size(); ++i)  // its own first
      if (follows(log, *speed, log.delta[(n + i) % log.delta.size()])) return false;
    told = true;
  }
  return told && log.has_commands();
}

}  // namespace ident
