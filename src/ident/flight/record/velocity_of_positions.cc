// Slopes of local parabolas.
#include "ident/flight/record/velocity_of_positions.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

constexpr double kJerk = 50.0;     // m/s^3: 5 m/s^2 within a tenth of a second
constexpr std::size_t kLeast = 5;  // samples of a parabola

struct Samples {
  std::vector<double> t, y;
};

// Of the samples [begin, end) about `at`; the unit of time keeps the equations well conditioned.
double slope(const Samples& samples, std::size_t begin, std::size_t end, double at) {
  const double unit =
      std::max({at - samples.t[begin], samples.t[end - 1] - at, samples.t[end - 1] - samples.t[begin]});
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (std::size_t k = begin; k < end; ++k) {
    const double s = (samples.t[k] - at) / unit;
    const Eigen::Vector3d row(1.0, s, s * s);
    A += row * row.transpose(), b += row * (samples.y[k] - samples.y[begin]);
  }
  if (end - begin < kLeast) A(2, 2) += 1e6;  // a line
  return A.ldlt().solve(b)[1] / unit;
}

}  // namespace

std::vector<double> velocity_of_positions(const std::vector<double>& t, std::span<const double> y,
                                          double sigma) {
  Samples samples;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (std::isfinite(y[i])) samples.t.push_back(t[i]), samples.y.push_back(y[i]);
  std::vector<double> out(t.size(), 0.0);
  const std::size_t n = samples.t.size();
  if (n < 2) return out;
  const double apart = (samples.t.back() - samples.t.front()) / static_cast<double>(n - 1);
  const double reach = std::pow(150 * sigma * sigma * apart / (kJerk * kJerk), 1.0 / 7.0);
  std::size_t begin = 0, end = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    while (begin < n && samples.t[begin] < t[i] - reach) ++begin;
    while (end < n && samples.t[end] <= t[i] + reach) ++end;
    std::size_t from = begin, to = std::max(begin, end);
    while (to - from < std::min(kLeast, n)) {  // the nearest ones, where few are within reach
      const bool later = from == 0 || (to < n && samples.t[to] - t[i] < t[i] - samples.t[from - 1]);
      later ? ++to : --from;
    }
    out[i] = slope(samples, from, to, t[i]);
  }
  return out;
}

}  // namespace ident
