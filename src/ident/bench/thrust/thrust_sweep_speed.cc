// The speed that counts without its sign, spikes, gaps.
#include "ident/bench/thrust/thrust_sweep_speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "ident/bench/columns/speed_column.h"
#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr std::ptrdiff_t kMedianReach = 7;

[[noreturn]] void refuse(const NumberTable& table) {
  throw DataError(fmt::format(
      "{}: no usable rotor speed ({}): kT and kQ need the speed of the rotor in at least {} rows at which it "
      "turns; connect the optical or the electrical sensor, or name the column omega or rpm",
      table.file, speed_columns_in_words(table), kFewestTurning));
}

}  // namespace

std::size_t remove_speed_spikes(std::vector<double>& Omega, double least) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < Omega.size(); ++i)
    if (std::isfinite(Omega[i])) rows.push_back(i);
  const auto n = static_cast<std::ptrdiff_t>(rows.size());
  std::vector<double> seen;
  for (const std::size_t i : rows) seen.push_back(Omega[i]);
  std::size_t spikes = 0;
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, k - kMedianReach),
                         to = std::min(n, k + kMedianReach + 1);
    const std::span<const double> window(seen.data() + from, static_cast<std::size_t>(to - from));
    const double middle = median(window);
    const auto at = static_cast<std::size_t>(k);
    if (std::fabs(seen[at] - middle) <= std::max(least, 6.0 * mad_scale(window, middle))) continue;
    Omega[rows[at]] = middle;
    ++spikes;
  }
  return spikes;
}

std::size_t fill_gaps(std::vector<double>& values, const std::vector<double>& place, double longest) {
  std::size_t filled = 0;
  for (std::size_t i = 1; i < values.size();) {
    if (std::isfinite(values[i]) || !std::isfinite(values[i - 1])) {
      ++i;
      continue;
    }
    std::size_t next = i;
    while (next < values.size() && !std::isfinite(values[next])) ++next;
    if (next == values.size()) break;
    const double span = place[next] - place[i - 1];
    for (std::size_t k = i; k < next && span <= longest; ++k, ++filled) {
      const double part = span > 0.0 ? (place[k] - place[i - 1]) / span : 0.5;
      values[k] = values[i - 1] + part * (values[next] - values[i - 1]);
    }
    i = next + 1;
  }
  return filled;
}

SweepSpeed sweep_speed(const NumberTable& table, std::vector<Warning>& warnings) {
  const Column* chosen = speed_column(table, warnings);
  if (!chosen) refuse(table);
  SweepSpeed speed{.Omega = chosen->values, .column = chosen->header};
  for (double& v : speed.Omega)
    if (v < 0.0) v = -v;  // the sense of rotation of a stand says nothing of the propeller
  return speed;
}

}  // namespace ident
