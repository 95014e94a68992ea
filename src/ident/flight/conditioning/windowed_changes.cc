// Running means, changes over windows and clipped correlations.
#include "ident/flight/conditioning/windowed_changes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kLongestShift = 0.06;  ///< s by which streams of one log may be apart

}  // namespace

ChangeWindows change_windows(double lag, double interval) {
  const auto rows = [&](double s) {
    return static_cast<std::size_t>(std::max(1.0, std::round(s / std::max(interval, 1e-6))));
  };
  return {rows(lag), rows(lag / 3), rows(lag / 2), rows(kLongestShift)};
}

RunningSum::RunningSum(const Track& x) : up_to(x.size() + 1, 0.0) {
  std::partial_sum(x.begin(), x.end(), up_to.begin() + 1);
}

Track changes(const RunningSum& x, const ChangeWindows& w, long shift) {
  Track out;
  const Track& sum = x.up_to;
  const double n = static_cast<double>(w.width);
  out.reserve(x.rows() / w.stride + 1);
  for (std::size_t i = w.margin; i + w.lag + w.width + w.margin <= x.rows(); i += w.stride) {
    const auto a = static_cast<std::size_t>(static_cast<long>(i) - shift), b = a + w.lag;
    out.push_back((sum[b + w.width] - sum[b] - sum[a + w.width] + sum[a]) / n);
  }
  return out;
}

Track integral(const std::vector<double>& t, const Track& y) {
  Track out(y.size(), 0.0);
  for (std::size_t i = 1; i < y.size(); ++i)
    out[i] = out[i - 1] + 0.5 * (t[i] - t[i - 1]) * (y[i] + y[i - 1]);
  return out;
}

Track channel_track(const FlightArc& arc, int channel) {
  Track out(arc.rows());
  double last = kNaN;
  bool any = false;
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    const double y = arc.y[i * kChannels + static_cast<std::size_t>(channel)];
    if (std::isfinite(y)) any = true, last = y;
    out[i] = last;
  }
  if (!any) return {};
  const auto first = std::ranges::find_if(out, [](double y) { return std::isfinite(y); });
  std::fill(out.begin(), first, *first);
  return out;
}

Track clipped_unit(Track x) {
  if (x.size() < 3) return {};
  const double low = quantile(x, 0.005), high = quantile(x, 0.995);
  for (double& v : x) v = std::clamp(v, low, high);
  const double middle = mean(x);
  double square = 0;
  for (double& v : x) v -= middle, square += v * v;
  if (!(square > 0)) return {};
  for (double& v : x) v /= std::sqrt(square);
  return x;
}

double correlation(const Track& a, const Track& b) {
  return a.empty() || b.empty() ? 0.0 : std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

Eigen::Matrix3d correlations(const Track3& seen, const Track3& told) {
  Track3 s, t;
  for (std::size_t k = 0; k < 3; ++k) s[k] = clipped_unit(seen[k]), t[k] = clipped_unit(told[k]);
  Eigen::Matrix3d c;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      c(i, k) = correlation(s[static_cast<std::size_t>(i)], t[static_cast<std::size_t>(k)]);
  return c;
}

void append(Track3& a, const Track3& b) {
  for (std::size_t k = 0; k < 3; ++k) a[k].insert(a[k].end(), b[k].begin(), b[k].end());
}

}  // namespace ident
