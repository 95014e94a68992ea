// Polynomials by least squares over a moving window.
#include "ident/io/log/undo_low_pass.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

// Of the polynomials. Parabolas lose 1.7 % at half the corner and 18 % at it, these 0.07 % and 2.8 %. What
// parabolas lose passed for rotor_drag behind filters of 20 Hz.
constexpr int kOrder = 4;
using Powers = Eigen::Matrix<double, kOrder + 1, 1>;

constexpr double kBand = 3.0;      // times the corner up to which the filter is undone
constexpr double kOften = 4.0;     // samples in a period of the corner, at least, for derivatives
constexpr double kHole = 1.5;      // times its usual length, of a window with a hole
constexpr double kMost = 500.0;    // samples on either side: 0.5 Hz at 1 kHz, and time grows with the log
constexpr std::size_t kLeast = 3;  // samples on either side

// Half the width of a moving polynomial that passes frequencies up to `band`, in samples [Schafer, What is a
// Savitzky-Golay filter, IEEE Signal Processing Magazine 28(4), 2011, (12): f_3dB = (n + 1)/(3.2 m - 4.6) of
// half the sampling rate].
std::size_t half_width(double band, double rate) {
  const double m = ((kOrder + 1) * 0.5 * rate / band + 4.6) / 3.2;
  return std::max(kLeast, static_cast<std::size_t>(std::min(m, kMost)));
}

Powers powers(double s) {
  Powers out;
  double power = 1.0;
  for (int k = 0; k <= kOrder; ++k, power *= s) out[k] = power;
  return out;
}

}  // namespace

bool undo_low_pass(std::vector<double>& t, std::vector<double>& values, const LowPass& filter) {
  if (!(filter.lag > 0) || t.size() < 2) return false;
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  const double step = median(steps);
  if (!(step * kOften * filter.corner() < 1)) {
    for (double& at : t) at -= filter.lag;
    return false;
  }
  const std::size_t m = half_width(kBand * filter.corner(), 1 / step);
  const double usual = 2 * static_cast<double>(m) * step;
  std::vector<double> out(values.size(), kNaN);
  for (std::size_t i = m; i + m < t.size(); ++i) {
    if (t[i + m] - t[i - m] > kHole * usual) continue;
    Powers b = Powers::Zero();
    Eigen::Matrix<double, kOrder + 1, kOrder + 1> A = b * b.transpose();
    for (std::size_t k = i - m; k <= i + m; ++k) {
      const Powers row = powers((t[k] - t[i]) / step);
      A += row * row.transpose(), b += values[k] * row;
    }
    const Powers c = A.ldlt().solve(b);
    out[i] = c[0] + filter.lag * c[1] / step + 2 * filter.square * c[2] / (step * step);
  }
  values = std::move(out);
  return true;
}

}  // namespace ident
