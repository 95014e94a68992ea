// The variance by two non-negative terms, fitted to squares that are cut where they stand out.
#include "ident/flight/ladder/error_by_speed.h"

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kCut = 3.0;     // deviations from which a window stands out
constexpr double kLeast = 0.02;  // of the mean variance: no window is trusted beyond that
constexpr int kRounds = 6;

}  // namespace

Eigen::VectorXd weight_by_speed(const std::vector<Window>& windows, const Eigen::VectorXd& residual) {
  const std::size_t n = windows.size();
  std::vector<double> size(n), variance(n);
  const Eigen::Index each = residual.size() / std::max<Eigen::Index>(std::ssize(windows), 1);
  const auto of = [&](std::size_t w) { return each * static_cast<Eigen::Index>(w); };
  for (std::size_t w = 0; w < n; ++w)
    size[w] = residual.segment(of(w), each).squaredNorm() / static_cast<double>(each);
  // The median of a mean of three squares is near 0.8 of their expectation.
  const double typical = std::max(median(size) / 0.8, 1e-18);
  variance.assign(n, typical);
  for (int round = 0; round < kRounds; ++round) {
    double A = 0, B = 0, C = 0, d = 0, e = 0;  // of the normal equations, relative errors being alike
    for (std::size_t w = 0; w < n; ++w) {
      const double s = windows[w].speed * windows[w].speed, k = 1 / (variance[w] * variance[w]);
      const double y = std::min(size[w], kCut * kCut * variance[w]);
      A += k, B += k * s, C += k * s * s, d += k * y, e += k * s * y;
    }
    const double det = A * C - B * B;
    double a = det > 1e-9 * A * C ? (d * C - e * B) / det : d / A,
           b = det > 1e-9 * A * C ? (A * e - B * d) / det : 0;
    if (b < 0) b = 0, a = d / A;
    if (a < 0) a = 0, b = e / C;
    for (std::size_t w = 0; w < n; ++w)
      variance[w] = std::max(a + b * windows[w].speed * windows[w].speed, kLeast * typical);
  }
  Eigen::VectorXd weight(residual.size());
  for (std::size_t w = 0; w < n; ++w) {
    const double apart = std::sqrt(size[w] / variance[w]);
    weight.segment(of(w), each).setConstant(std::min(1.0, kCut / std::max(apart, 1e-9)) / variance[w]);
  }
  return weight;
}

}  // namespace ident
