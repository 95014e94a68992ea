// Parabolas by least squares over a moving window.
#include "ident/io/log/undo_low_pass.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kBand = 3.0;      // times the cutoff up to which the filter is undone
constexpr double kOften = 4.0;     // samples in a period of the cutoff, at least, for derivatives
constexpr double kHole = 1.5;      // times its usual length, of a window with a hole
constexpr std::size_t kLeast = 2;  // samples on either side

// Half the width of a moving parabola that passes frequencies up to `band`, in samples [Schafer, What is a
// Savitzky-Golay filter, IEEE Signal Processing Magazine 28(4), 2011, (12): f_3dB = (n + 1)/(3.2 m - 4.6) of
// half the sampling rate, n = 2].
std::size_t half_width(double band, double rate) {
  const double m = (3 * 0.5 * rate / band + 4.6) / 3.2;
  return std::max(kLeast, static_cast<std::size_t>(m));
}

}  // namespace

bool undo_low_pass(std::vector<double>& t, std::vector<double>& values, double cutoff) {
  if (!(cutoff > 0) || t.size() < 2) return false;
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  const double step = median(steps), w = 2 * std::numbers::pi * cutoff, delay = std::numbers::sqrt2 / w;
  if (!(step * kOften * cutoff < 1)) {
    for (double& at : t) at -= delay;
    return false;
  }
  const std::size_t m = half_width(kBand * cutoff, 1 / step);
  const double usual = 2 * static_cast<double>(m) * step;
  std::vector<double> out(values.size(), kNaN);
  for (std::size_t i = m; i + m < t.size(); ++i) {
    if (t[i + m] - t[i - m] > kHole * usual) continue;
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (std::size_t k = i - m; k <= i + m; ++k) {
      const double s = (t[k] - t[i]) / step;
      const Eigen::Vector3d row(1, s, s * s);
      A += row * row.transpose(), b += values[k] * row;
    }
    const Eigen::Vector3d c = A.ldlt().solve(b);
    out[i] = c[0] + delay * c[1] / step + 2 * c[2] / (w * w * step * step);
  }
  values = std::move(out);
  return true;
}

}  // namespace ident
