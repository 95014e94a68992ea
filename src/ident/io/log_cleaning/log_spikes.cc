// A sample against the cubic through the two before and the two after it.
#include "ident/io/log_cleaning/log_spikes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/core/parallel.h"

namespace ident {
namespace {

// Off by so many of the usual deviations, and by so many times what all but a twentieth of the samples are:
// in a log that is slow against its flight what is usual says little of a turn.
constexpr double kUsualSpread = 25.0;
constexpr double kMostSpikes = 6.0;
// What the neighbours differ, against a spike; and the share of a signal beyond which it is no accident.
constexpr double kAgree = 0.3;
constexpr double kAccident = 0.01;
constexpr double kImpossible = 100.0;  // times what all but a hundredth of the commands are
constexpr double kOneSpikeGap = 3.0;  // times the usual step: samples further apart say nothing of each other
// What comes and goes at once and lasts no longer than so many s is no motion: rotors take longer to push.
constexpr double kSudden = 0.011;
constexpr std::size_t kFewSamples = 50;
constexpr double kNormalSpread = 1.4826;  // standard deviation over the median of sizes

/// Quantiles at rising shares.
template <std::size_t count>
std::array<double, count> quantiles(std::vector<double> values, const std::array<double, count>& shares) {
  std::array<double, count> out;
  auto from = values.begin();
  for (std::size_t i = 0; i < count; ++i) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(shares[i] * static_cast<double>(values.size() - 1));
    std::nth_element(from, at, values.end());
    out[i] = *at, from = at;  // what follows is not smaller
  }
  return out;
}

// Rows between a jump of more than `limit` and one back that undoes it; single ones are spikes already. What
// comes to a peak step by step is motion: before the first jump and after the last nothing like it happens.
void add_excursions(const std::vector<double>& t, const std::vector<double>& values,
                    const std::vector<std::size_t>& rows, double limit, std::vector<std::size_t>& spikes) {
  const auto jump = [&](std::size_t k) { return values[rows[k + 1]] - values[rows[k]]; };
  for (std::size_t from = 1; from + 3 < rows.size(); ++from) {
    const double up = jump(from);
    const auto still = [&](std::size_t k) { return std::abs(jump(k)) < kAgree * std::abs(up); };
    if (!(std::abs(up) > limit) || !still(from - 1)) continue;
    for (std::size_t to = from + 1; to + 2 < rows.size(); ++to) {
      if (t[rows[to + 1]] - t[rows[from]] > kSudden) break;
      const double down = jump(to);
      if (std::abs(up + down) < kAgree * std::abs(up)) {
        if (to > from + 1 && still(to + 1))
          for (std::size_t k = from + 1; k <= to; ++k) spikes.push_back(rows[k]);
        from = to;
        break;
      }
      if (std::abs(down) > kAgree * std::abs(up)) break;
    }
  }
}

// Rows whose value is a spike.
std::vector<std::size_t> spikes_of(const std::vector<double>& t, const std::vector<double>& values) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i])) rows.push_back(i);
  if (rows.size() < kFewSamples) return {};
  std::vector<double> steps;
  for (std::size_t k = 1; k < rows.size(); ++k) steps.push_back(t[rows[k]] - t[rows[k - 1]]);
  const double together = kOneSpikeGap * 4 * quantiles<1>(std::move(steps), {0.5})[0];
  std::vector<double> off(rows.size(), 0.0);
  const auto at = [&](std::size_t k) { return values[rows[k]]; };
  for (std::size_t k = 2; k + 2 < rows.size(); ++k)
    if (t[rows[k + 2]] - t[rows[k - 2]] < together)
      off[k] = std::abs(at(k) - (4 * (at(k - 1) + at(k + 1)) - at(k - 2) - at(k + 2)) / 6);
  const auto [middle, most] = quantiles<2>(off, {0.5, 0.95});
  const double usual = kNormalSpread * middle;
  if (!(usual > 0)) return {};  // steps of a coarse sensor
  const double limit = std::max(kUsualSpread * usual, kMostSpikes * most);
  std::vector<std::size_t> spikes;
  for (std::size_t k = 2; k + 2 < rows.size(); ++k) {
    if (!(off[k] > limit)) continue;
    const bool largest = *std::max_element(off.begin() + static_cast<std::ptrdiff_t>(k) - 2,
                                           off.begin() + static_cast<std::ptrdiff_t>(k) + 3) == off[k];
    if (!largest) continue;
    const std::array<double, 4> around{at(k - 2), at(k - 1), at(k + 1), at(k + 2)};
    const auto [low, high] = std::ranges::minmax(around);
    if (high - low < kAgree * std::abs(at(k) - 0.5 * (low + high))) spikes.push_back(rows[k]);
  }
  add_excursions(t, values, rows, limit, spikes);
  const bool accident = static_cast<double>(spikes.size()) < kAccident * static_cast<double>(rows.size());
  return accident ? spikes : std::vector<std::size_t>{};
}

// Rows whose value is of another kind than the rest.
std::vector<std::size_t> impossible_in(const std::vector<double>& values) {
  std::vector<double> sizes;
  for (const double value : values)
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  std::vector<std::size_t> out;
  if (sizes.size() < kFewSamples) return out;
  const double most = kImpossible * quantiles<1>(std::move(sizes), {1 - kAccident})[0];
  for (std::size_t i = 0; i < values.size() && most > 0; ++i)
    if (std::abs(values[i]) > most) out.push_back(i);
  return out;
}

void drop(FlightLog& log, Components sensor, const std::string& name,
          const std::function<std::vector<std::size_t>(const std::vector<double>&)>& wrong_rows) {
  std::size_t count = 0;
  double first = kNaN;
  std::vector<std::vector<std::size_t>> wrong(sensor.size());
  in_parallel(sensor.size(), [&](std::size_t k) { wrong[k] = wrong_rows(sensor[k]); });
  for (std::size_t k = 0; k < sensor.size(); ++k)
    for (const std::size_t i : wrong[k]) {
      sensor[k][i] = kNaN, ++count;
      if (!(log.t[i] > first)) first = log.t[i];
    }
  if (count == 0) return;
  log.warnings.push_back(
      {"spikes", fmt::format("{}: {}: values far off the ones around them count as not sampled: {}, the "
                             "first at t = {:.6g} s",
                             log.file, name, count, first)});
}

}  // namespace

void drop_spikes(FlightLog& log, Components sensor, const std::string& name) {
  drop(log, sensor, name, [&](const std::vector<double>& values) { return spikes_of(log.t, values); });
}

void drop_impossible(FlightLog& log, Components commands, const std::string& name) {
  drop(log, commands, name, impossible_in);
}

}  // namespace ident
