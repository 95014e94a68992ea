// Distribution functions by continued fractions, robust summaries, autocorrelation.
#include "ident/core/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ident/core/math.h"

namespace ident {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Continued fraction of the incomplete beta function, modified Lentz method [Abramowitz, Stegun 26.5.8].
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  const auto guarded = [](double v) { return std::fabs(v) < tiny ? tiny : v; };
  double c = 1.0;
  double d = 1.0 / guarded(1.0 - (a + b) * x / (a + 1.0));
  double h = d;
  for (int m = 1; m < 10000; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / guarded(1.0 + even * d);
    c = guarded(1.0 + even / c);
    h *= c * d;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / guarded(1.0 + odd * d);
    c = guarded(1.0 + odd / c);
    h *= c * d;
    if (std::fabs(c * d - 1.0) < 1e-15) break;
  }
  return h;
}

/// Regularised incomplete beta function I_x(a, b).
double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
  return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

/// Regularised lower incomplete gamma function P(a, x): series below a + 1, continued fraction above.
double incomplete_gamma(double a, double x) {
  if (x <= 0.0) return 0.0;
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-17; ++n) sum += term *= x / (a + n);
    return front * sum;
  }
  double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    h *= c * d;
    if (std::fabs(c * d - 1.0) < 1e-15) break;
  }
  return 1.0 - front * h;
}

std::vector<double> finite(std::span<const double> x) {
  std::vector<double> kept;
  std::ranges::copy_if(x, std::back_inserter(kept), [](double v) { return std::isfinite(v); });
  return kept;
}

/// Two-sided t quantile for one mistake in twenty samples of size n; beyond 300 degrees of freedom by the
/// first term of its expansion about the normal one, which is right to 1e-4 there.
double rejection_cut(std::size_t n, double dof) {
  const double p = 1.0 - 0.025 / static_cast<double>(n);
  if (dof <= 300.0) return t_quantile(p, dof);
  const double z = normal_quantile(p);
  return z * (1.0 + (z * z + 1.0) / (4.0 * dof));
}

}  // namespace

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

double normal_quantile(double p) {
  if (p <= 0.0) return -kInfinity;
  if (p >= 1.0) return kInfinity;
  if (p > 0.5) return -normal_quantile(1.0 - p);
  const double t = std::sqrt(-2.0 * std::log(p));  // [Abramowitz, Stegun 26.2.23], then Newton-Halley
  double z = -(t - (2.515517 + 0.802853 * t + 0.010328 * t * t) /
                       (1.0 + 1.432788 * t + 0.189269 * t * t + 0.001308 * t * t * t));
  for (int i = 0; i < 4; ++i) {
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * M_PI);
    const double step = (normal_cdf(z) - p) / density;
    z -= step / (1.0 + 0.5 * z * step);
  }
  return z;
}

double t_cdf(double t, double dof) {
  if (!std::isfinite(dof)) return normal_cdf(t);
  const double tail = 0.5 * incomplete_beta(0.5 * dof, 0.5, dof / (dof + t * t));
  return t > 0.0 ? 1.0 - tail : tail;
}

double t_quantile(double p, double dof) {
  if (!std::isfinite(dof) || dof > 1e7) return normal_quantile(p);
  if (p <= 0.0 || p >= 1.0) return p <= 0.0 ? -kInfinity : kInfinity;
  if (p > 0.5) return -t_quantile(1.0 - p, dof);
  double low = -1.0, high = 0.0;
  while (t_cdf(low, dof) > p && low > -1e100) low *= 2.0;
  while (high - low > 1e-14 * std::fabs(low)) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (t_cdf(middle, dof) > p ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

double t95(double dof) { return t_quantile(0.975, dof); }

double f_cdf(double f, double dof1, double dof2) {
  if (f <= 0.0) return 0.0;
  if (!std::isfinite(dof2)) return chi2_cdf(dof1 * f, dof1);
  return incomplete_beta(0.5 * dof1, 0.5 * dof2, dof1 * f / (dof1 * f + dof2));
}

double chi2_cdf(double x, double dof) { return incomplete_gamma(0.5 * dof, 0.5 * x); }

double two_sided_p(double t, double dof) { return 2.0 * t_cdf(-std::fabs(t), dof); }

double mean(std::span<const double> x) {
  double sum = 0.0;
  std::size_t n = 0;
  for (const double v : x)
    if (std::isfinite(v)) sum += v, ++n;
  return n ? sum / static_cast<double>(n) : kNaN;
}

double standard_deviation(std::span<const double> x) {
  const double m = mean(x);
  double sum = 0.0;
  std::size_t n = 0;
  for (const double v : x)
    if (std::isfinite(v)) sum += (v - m) * (v - m), ++n;
  return n > 1 ? std::sqrt(sum / static_cast<double>(n - 1)) : kNaN;
}

double quantile(std::span<const double> x, double p) {
  std::vector<double> sorted = finite(x);
  if (sorted.empty()) return kNaN;
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(place);
  std::nth_element(sorted.begin(), sorted.begin() + below, sorted.end());
  const double low = sorted[static_cast<std::size_t>(below)];
  const double share = place - static_cast<double>(below);
  if (share == 0.0) return low;
  return low + share * (*std::min_element(sorted.begin() + below + 1, sorted.end()) - low);
}

double median(std::span<const double> x) { return quantile(x, 0.5); }

double mad_scale(std::span<const double> x, double center) {
  std::vector<double> distance(x.begin(), x.end());
  for (double& d : distance) d = std::fabs(d - center);
  return 1.482602218505602 * median(distance);  // 1/normal_quantile(0.75)
}

double root_mean_square(std::span<const double> x) {
  double sum = 0.0;
  std::size_t n = 0;
  for (const double v : x)
    if (std::isfinite(v)) sum += v * v, ++n;
  return n ? std::sqrt(sum / static_cast<double>(n)) : kNaN;
}

double outlier_cut(std::size_t sample_size) {
  return std::max(3.0,
                  normal_quantile(1.0 - 0.025 / static_cast<double>(std::max<std::size_t>(1, sample_size))));
}

double truncated_variance(double cut) {
  const double density = std::exp(-0.5 * cut * cut) / std::sqrt(2.0 * M_PI);
  return 1.0 - 2.0 * cut * density / (2.0 * normal_cdf(cut) - 1.0);
}

RobustMean robust_mean(std::span<const double> x) {
  std::vector<double> kept = finite(x);
  const std::size_t n = kept.size();
  const double center = median(kept);
  std::ranges::sort(kept, {}, [&](double v) { return std::fabs(v - center); });
  std::size_t used = n;
  if (n >= 5) {
    // Values are taken in from the middle outwards; the first one that the inner ones make implausible ends
    // it.
    used = (n + 1) / 2 + 1;
    double middle = 0.0, squares = 0.0;  // of the inner values, carried on from one to the next [Welford]
    const auto take_in = [&](std::size_t i) {
      const double step = kept[i] - middle;
      middle += step / static_cast<double>(i + 1);
      squares += step * (kept[i] - middle);
    };
    for (std::size_t i = 0; i < used; ++i) take_in(i);
    for (; used < n; take_in(used), ++used) {
      // The inner values of a normal sample spread less than all of it: as many as `used` of n lie within
      // +- q standard deviations.
      const double share = (static_cast<double>(used) - 0.5) / static_cast<double>(n);
      const double q = normal_quantile(0.5 + 0.5 * share), dof = static_cast<double>(used - 1);
      const double scale = std::sqrt(squares / dof / truncated_variance(q));
      if (std::fabs(kept[used] - middle) >
          rejection_cut(n, dof) * scale * std::sqrt(1.0 + 1.0 / static_cast<double>(used)))
        break;
    }
  }
  const std::span<const double> inner(kept.data(), used);
  const double scale = standard_deviation(inner);
  return {.value = mean(inner),
          .std = scale / std::sqrt(static_cast<double>(used)),
          .scale = scale,
          .dof = static_cast<double>(used) - 1.0,
          .used = used,
          .rejected = n - used};
}

std::vector<double> autocorrelation(std::span<const double> x, std::size_t max_lag) {
  const double m = mean(x);
  std::vector<double> result;
  double variance = 0.0;
  for (std::size_t lag = 0; lag <= max_lag && lag < x.size(); ++lag) {
    double sum = 0.0;
    for (std::size_t i = lag; i < x.size(); ++i) {
      const double product = (x[i] - m) * (x[i - lag] - m);
      if (std::isfinite(product)) sum += product;
    }
    if (lag == 0) variance = sum;
    result.push_back(variance > 0.0 ? sum / variance : 0.0);
  }
  return result;
}

double r_squared(std::span<const double> y, std::span<const double> residual) {
  const double m = mean(y);
  double total = 0.0, left = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!std::isfinite(y[i]) || !std::isfinite(residual[i])) continue;
    total += (y[i] - m) * (y[i] - m);
    left += residual[i] * residual[i];
  }
  return 1.0 - left / total;
}

}  // namespace ident
