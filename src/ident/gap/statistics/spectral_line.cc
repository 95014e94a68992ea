// Welch spectra over all logs, compared with their own running median.
#include "ident/gap/statistics/spectral_line.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "ident/core/parallel.h"
#include "ident/core/periodograms.h"
#include "ident/core/stage_times.h"
#include "ident/flight/conditioning/estimator_drift.h"
#include "ident/flight/conditioning/rotor_tones.h"

namespace ident {
namespace {

constexpr double kChance = 5.6;     // standard deviations: one in ten thousand over some ten thousand bins
constexpr double kMaterial = 0.02;  // share of the variance
// Height of a line of an acceleration from outside over what is around it: what the smoother makes of gusts
// is not as even as what sensors leave.
constexpr double kAirLine = 8.0;

using Pieces = std::vector<std::vector<double>>;  // of a series, evenly sampled, one for each arc

// Of half overlapping stretches.
Periodograms welch(const Pieces& pieces, std::size_t length) {
  Periodograms out(length);
  for (const std::vector<double>& x : pieces)
    for (std::size_t from = 0; from + length <= x.size(); from += length / 2) {
      const auto stretch = std::span(x).subspan(from, length);
      out.add(stretch, std::accumulate(stretch.begin(), stretch.end(), 0.0) / static_cast<double>(length));
    }
  return out;
}

double running_median(const std::vector<double>& power, std::size_t k) {
  const std::size_t half = std::max<std::size_t>(6, k / 4), first = k > half ? k - half : 1;
  std::vector<double> around(
      power.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(first, 1)),
      power.begin() + static_cast<std::ptrdiff_t>(std::min(k + half + 1, power.size())));
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
  std::nth_element(around.begin(), middle, around.end());
  return *middle;
}

// The strongest line of a series sampled every h seconds, if there is one. `air`: of an acceleration from
// outside, of which the smoother leaves next to nothing at the upper end of the band: any ripple there looks
// like a line.
void look_for_line(const std::string& channel, const Pieces& pieces, double h, bool air,
                   std::vector<SpectralLine>& out) {
  std::size_t longest = 0;
  for (const auto& piece : pieces) longest = std::max(longest, piece.size());
  std::size_t length = 1024;
  while (length * 4 > longest && length > 64) length /= 2;
  if (length * 4 > longest) return;
  const Periodograms stretches = welch(pieces, length);
  const std::vector<double>& power = stretches.power();
  // Quantile of the mean of so many periodograms over its median (Wilson and Hilferty).
  const double v = 1 / (9 * 0.8 * stretches.count()),
               chance = std::pow((1 - v + kChance * std::sqrt(v)) / (1 - v), 3);
  const double most = air ? std::max(chance, kAirLine) : chance;
  double total = 0, best = 0, share = 0;
  std::size_t at = 0;
  for (std::size_t k = 1; k < power.size(); ++k) total += power[k];
  const auto last = static_cast<std::size_t>((air ? 0.8 : 1.0) * static_cast<double>(power.size()));
  for (std::size_t k = 4; k + 2 < last; ++k) {
    if (power[k] < power[k - 1] || power[k] < power[k + 1]) continue;
    const double around = running_median(power, k), height = power[k] / std::max(around, 1e-300);
    if (height <= best) continue;
    best = height, at = k;
    share = (power[k - 1] + power[k] + power[k + 1] - 3 * around) / total;
  }
  if (best > most && share > kMaterial)
    out.push_back({channel, static_cast<double>(at) / (static_cast<double>(length) * h), best, share});
}

// The channels that show the same motion once more differentiated, or twice, and how often; none without.
struct Differentiated {
  int first = -1, times = 0;
};
Differentiated differentiated(const Signals& logged, int channel) {
  if (channel >= kAttitude && channel < kAttitude + 3 && logged.rates) return {kGyro, 1};
  if (channel >= kVelocity && channel < kVelocity + 3 && logged.force) return {kForce, 1};
  if (channel >= kPosition && channel < kPosition + 3 && logged.force) return {kForce, 2};
  return {};
}

// Whether what moves like that would stand out more in rates or specific force, and does not stand out there
// at all: an estimator did it, or how it was aided.
bool is_of_no_motion(const FlightRecord& record, const NoiseModel& noise,
                     const std::vector<std::vector<SpectralLine>>& found, int channel,
                     const SpectralLine& line) {
  const auto [first, times] = differentiated(record.signals, channel);
  if (first < 0) return false;
  const auto sigma = [&](int c) { return noise.sigma[static_cast<std::size_t>(c)]; };
  const double gain = std::pow(2 * M_PI * line.hz, times);
  if (!(gain * sigma(channel) > std::max({sigma(first), sigma(first + 1), sigma(first + 2)}))) return false;
  constexpr double kSame = 0.1;  // of the frequency
  for (int c = first; c < first + 3; ++c)
    for (const SpectralLine& other : found[static_cast<std::size_t>(c)])
      if (std::abs(other.hz - line.hz) < kSame * line.hz) return false;
  return true;
}

// Turns a second of the rotors, all together, as states show them.
double mean_turns(const FlightRecord& record, const FlightFit& fit) {
  const int rotors = record.layout.motors >= 0 ? record.layout.rotors : 0;
  double sum = 0, count = 0;
  for (const FlightState<double>& x : fit.smoother->states())
    for (int n = 0; n < rotors; ++n)
      sum += x.motors[static_cast<std::size_t>(n)].Omega / (2 * M_PI), count += 1;
  return sum / count;
}

}  // namespace

std::vector<SpectralLine> spectral_lines(const FlightRecord& record, const FlightFit& fit) {
  const Stage stage("what is left");
  const auto residuals = fit.smoother->residuals();
  const auto& places = fit.smoother->chunks();
  const auto& states = fit.smoother->states();
  const double turns = mean_turns(record, fit);
  std::vector<std::vector<SpectralLine>> found(kChannels + 6);
  const auto look_at_sensor = [&](int channel) {
    if (is_slowly_off(record, channel)) return;
    Pieces pieces(record.arcs.size());
    double seconds = 0, samples = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const FlightArc& arc = record.arcs[static_cast<std::size_t>(places[k].arc)];
      for (std::size_t i = 0; i < places[k].end - places[k].begin; ++i) {
        const double r = residuals[k][i * kChannels + static_cast<std::size_t>(channel)];
        if (std::isfinite(r))
          pieces[static_cast<std::size_t>(places[k].arc)].push_back(std::clamp(r, -6.0, 6.0));
      }
      seconds += arc.t[places[k].end] - arc.t[places[k].begin];
    }
    for (const auto& piece : pieces) samples += static_cast<double>(piece.size());
    if (samples <= 512) return;
    std::vector<SpectralLine>& lines = found[static_cast<std::size_t>(channel)];
    look_for_line(channel_name(channel), pieces, seconds / samples, false, lines);
    constexpr double kAlike = 0.02;  // of the turns: rotors do not all turn alike, nor all the time
    for (SpectralLine& line : lines)
      if (channel < kAttitude && std::abs(folded(turns, samples / seconds) - line.hz) < kAlike * turns)
        line.rotor_hz = turns;
  };
  static constexpr std::array names = {"Mx", "My", "Mz", "Fx", "Fy", "Fz"};
  const auto look_at_air = [&](int axis) {
    Pieces pieces(record.arcs.size());
    double seconds = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const FlightArc& arc = record.arcs[static_cast<std::size_t>(places[k].arc)];
      const Disturbance<double>& air = states[k].outside;
      pieces[static_cast<std::size_t>(places[k].arc)].push_back(axis < 3 ? air.w_dot_B[axis]
                                                                         : air.v_dot[axis - 3]);
      seconds += arc.t[places[k].end] - arc.t[places[k].begin];
    }
    look_for_line(names[static_cast<std::size_t>(axis)], pieces, seconds / static_cast<double>(places.size()),
                  true, found[static_cast<std::size_t>(kChannels + axis)]);
  };
  in_parallel(found.size(), [&](std::size_t i) {
    const int series = static_cast<int>(i);
    series < kChannels ? look_at_sensor(series) : look_at_air(series - kChannels);
  });
  std::vector<SpectralLine> out;
  for (std::size_t series = 0; series < found.size(); ++series)
    for (const SpectralLine& line : found[series])
      if (!is_of_no_motion(record, fit.noise, found, static_cast<int>(series), line)) out.push_back(line);
  std::ranges::sort(out, std::greater<>(), &SpectralLine::height);
  return out;
}

}  // namespace ident
