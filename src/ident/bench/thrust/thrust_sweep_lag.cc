// Lag of a load cell behind the rotor speed, from a ramp.
#include "ident/bench/thrust/thrust_sweep_lag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr std::array kLags = {0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0};  // s
constexpr std::size_t kFewestLagRows = 20;
constexpr std::size_t kMostStretches = 60;

/// x' = (Omega^2 - x)/lag, exact for a speed that is held between rows.
std::vector<double> lagged_square(const SweepRows& rows, double lag) {
  std::vector<double> x(rows.size(), kNaN);
  double state = kNaN, last = kNaN;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double now = rows.Omega[i] * rows.Omega[i];
    if (!std::isfinite(now)) continue;
    const double keep = std::isfinite(state) && lag > 0.0 ? std::exp(-(rows.place[i] - last) / lag) : 0.0;
    state = keep > 0.0 ? now + keep * (state - now) : now;
    last = rows.place[i];
    x[i] = state;
  }
  return x;
}

/// Scatter of y about its line over x, by the median.
double scatter(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    n += 1, sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), offset = (sy - slope * sx) / n;
  std::vector<double> left;
  for (std::size_t i = 0; i < x.size(); ++i) left.push_back(y[i] - offset - slope * x[i]);
  return mad_scale(left);
}

}  // namespace

LaggedPoints lagged_points(const SweepRows& rows, const std::vector<double>& y) {
  LaggedPoints found;
  std::vector<std::size_t> with_value;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::isfinite(y[i]) && rows.Omega[i] > 0.0) with_value.push_back(i);
  if (with_value.size() < kFewestLagRows) return found;
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> x;
  for (const double lag : kLags) {
    std::vector<double> candidate = lagged_square(rows, lag);
    const double left = scatter(candidate, y);
    if (!(left < least)) continue;
    least = left, found.lag = lag, x = std::move(candidate);
  }
  const std::size_t length = std::max<std::size_t>(3, with_value.size() / kMostStretches);
  for (std::size_t begin = 0; begin + length <= with_value.size(); begin += length) {
    std::vector<double> values, squares, places;
    for (std::size_t k = begin; k < begin + length; ++k) {
      values.push_back(y[with_value[k]]);
      squares.push_back(x[with_value[k]]);
      places.push_back(rows.place[with_value[k]]);
    }
    found.points.push_back({std::sqrt(mean(squares)), mean(values), mean(places), -1});
  }
  return found;
}

}  // namespace ident
