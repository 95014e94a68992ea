// Chi-squared probabilities by the series and the continued fraction of the incomplete gamma function.
#include "chi_squared.h"

#include <cmath>

namespace withheld {

namespace {

double gamma_upper(double a, double x) {  // regularised Q(a, x)
  if (x <= 0) return 1;
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-16; ++n) sum += term *= x / n;
    return 1 - front * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int i = 1; i < 500; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return front * h;
}

}  // namespace

double chi_squared_upper(double x, double freedom) { return gamma_upper(freedom / 2, x / 2); }

double noncentral_upper(double x, double freedom, double noncentrality) {
  double weight = std::exp(-noncentrality / 2), sum = 0, used = 0;
  for (int j = 0; j < 2000 && used < 1 - 1e-13; ++j) {
    sum += weight * chi_squared_upper(x, freedom + 2 * j);
    used += weight;
    weight *= noncentrality / 2 / (j + 1);
  }
  return sum;
}

double noncentrality_for(double freedom, double alpha, double power) {
  double low = 0, high = 200;
  for (int i = 0; i < 200; ++i) {
    const double x = (low + high) / 2;
    (chi_squared_upper(x, freedom) > alpha ? low : high) = x;
  }
  const double threshold = low;
  low = 0, high = 200;
  for (int i = 0; i < 200; ++i) {
    const double x = (low + high) / 2;
    (noncentral_upper(threshold, freedom, x) < power ? low : high) = x;
  }
  return low;
}

}  // namespace withheld
