// Interpolation between the samples that there are.
#include "ident/flight/conditioning/shift_log.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ident/core/math.h"

namespace ident {
namespace {

/// The cubic through four samples; a line through the middle two where the others are far off, as at a gap.
double interpolated_at(double when, const double* t, const double* y) {
  const double h = t[2] - t[1], share = (when - t[1]) / h;
  constexpr double kEvenLog = 1.5;
  if (!(t[1] - t[0] < kEvenLog * h) || !(t[3] - t[2] < kEvenLog * h)) return y[1] + share * (y[2] - y[1]);
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    double weight = y[i];
    for (int k = 0; k < 4; ++k)
      if (k != i) weight *= (when - t[k]) / (t[i] - t[k]);
    sum += weight;
  }
  return sum;
}

}  // namespace

void read_later(const std::vector<double>& t, std::vector<double>& column, double seconds) {
  std::vector<double> at, y;
  for (std::size_t i = 0; i < column.size(); ++i)
    if (std::isfinite(column[i])) at.push_back(t[i]), y.push_back(column[i]);
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (!std::isfinite(column[i])) continue;
    const double when = t[i] + seconds;
    const auto after = static_cast<std::size_t>(std::ranges::upper_bound(at, when) - at.begin());
    column[i] = kNaN;
    if (after < 2 || after + 1 >= at.size()) continue;
    column[i] = interpolated_at(when, &at[after - 2], &y[after - 2]);
  }
}

void read_attitude_later(FlightLog& log, double seconds) {
  std::array<double, 4> last{1, 0, 0, 0};
  for (std::size_t i = 0; i < log.rows(); ++i) {  // q and -q are one attitude: no jump to interpolate over
    double dot = 0;
    for (std::size_t k = 0; k < 4; ++k) dot += last[k] * log.q_WB[k][i];
    if (!std::isfinite(dot)) continue;
    for (std::size_t k = 0; k < 4; ++k) last[k] = log.q_WB[k][i] *= dot < 0 ? -1.0 : 1.0;
  }
  for (auto& column : log.q_WB) read_later(log.t, column, seconds);
  for (std::size_t i = 0; i < log.rows(); ++i) {
    const double norm =
        std::hypot(std::hypot(log.q_WB[0][i], log.q_WB[1][i]), std::hypot(log.q_WB[2][i], log.q_WB[3][i]));
    for (auto& column : log.q_WB) column[i] /= norm;
  }
}

}  // namespace ident
