// A local level and a load, by Kalman's filter. What is seen at a sample is
//   v = b - R L + e,
// e white noise; b follows a random walk; R is the battery's resistance to a load L, the mean cube of the
// commands as motors follow them. Steps of the walk and noise by the likelihood [Harvey, Forecasting,
// Structural Time Series Models and the Kalman Filter, ch. 3], R by regression of the innovations of v on
// those of L.
#include "ident/flight/conditioning/smooth_voltage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "ident/core/statistics.h"
#include "ident/data/sampling.h"
#include "ident/flight/record/command_history.h"
#include "ident/flight/record/initial_states.h"

namespace ident {
namespace {

constexpr std::size_t kFewestVoltages = 50, kEnough = 3000;  // samples to judge noise by
constexpr double kFast = 10.0;  // variances of noise, that the level changes by from sample to sample: as
                                // good as no noise
constexpr double kSure = 3.0;   // deviations of a resistance
constexpr std::array kLags = {0.0,   0.015, 0.022, 0.032, 0.046,
                              0.068, 0.1,   0.15,  0.3};  // s by which a load shows later
// Steps of the walk that are tried, in variances of the noise from sample to sample.
constexpr double kSlowest = 1e-6, kFastest = 1e4, kStep = 2.0;

using Track = std::vector<double>;  // by row

struct Samples {
  std::vector<double> t, v, load;
};

// Local level in units of the noise: variance of what is known of it after the sample, and before the next.
struct Level {
  double variance = 1.0, before = 1.0;

  // Gain of the next sample; `grown`: variance of what it changed by until then.
  double next(double grown) {
    before = variance + grown;
    const double gain = before / (before + 1);
    variance = gain;
    return gain;
  }
};

// Sums over innovations, each over its variance.
struct Innovations {
  double vv = 0, vL = 0, LL = 0, log_variance = 0, count = 0;

  Innovations(const Samples& s, double per_second) {
    Level level;
    double v = s.v[0], L = s.load[0];
    for (std::size_t k = 1; k < s.t.size(); ++k) {
      const double gain = level.next(per_second * (s.t[k] - s.t[k - 1]));
      const double of_v = s.v[k] - v, of_L = s.load[k] - L, variance = level.before + 1;
      vv += of_v * of_v / variance, vL += of_v * of_L / variance, LL += of_L * of_L / variance;
      log_variance += std::log(variance), count += 1;
      v += gain * of_v, L += gain * of_L;
    }
  }

  // 0 where the flight does not tell.
  double resistance() const {
    const double R = LL > 0 ? -vL / LL : 0.0;
    return R > 0 && R * R * LL > kSure * kSure * noise(R) ? R : 0.0;
  }
  double noise(double R) const { return (vv + 2 * R * vL + R * R * LL) / count; }  // variance, V^2
  double surprise() const { return count * std::log(std::max(noise(resistance()), 1e-300)) + log_variance; }
};

std::vector<double> smoothed(const Samples& s, double R, double per_second) {
  const std::size_t n = s.t.size();
  std::vector<double> b(n), known(n), before(n);
  Level level;
  for (std::size_t k = 0; k < n; ++k) {
    const double seen = s.v[k] + R * s.load[k];
    if (k > 0) {
      const double gain = level.next(per_second * (s.t[k] - s.t[k - 1]));
      b[k] = b[k - 1] + gain * (seen - b[k - 1]);
    } else {
      b[k] = seen;
    }
    known[k] = level.variance, before[k] = level.before;
  }
  for (std::size_t k = n - 1; k-- > 0;) b[k] += known[k] / before[k + 1] * (b[k + 1] - b[k]);
  return b;
}

// Commands so much later, s, as by motors that are critically damped.
Track later(const std::vector<double>& t, Track x, double lag) {
  if (lag <= 0) return x;
  double between = x.front(), held = x.front();  // from the row before
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double share = -std::expm1(-(t[i] - t[i - 1]) / (lag / 2));
    between += share * (held - between);
    held = std::exchange(x[i], x[i - 1] + share * (between - x[i - 1]));
  }
  return x;
}

// Mean cube of the commands at each row, so much later.
Track load_of(const FlightLog& log, const std::vector<Track>& commands, double lag) {
  Track mean(log.rows(), 0.0);
  for (const Track& command : commands) {
    const Track speed = later(log.t, command, lag);
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += speed[i] * speed[i] * speed[i] / static_cast<double>(commands.size());
  }
  return mean;
}

std::vector<Track> commands_at_rows(const FlightLog& log) {
  std::vector<Track> out;
  for (const HeldCommand& command : command_history(log, log.t.front(), log.t.back())) {
    Track& rows = out.emplace_back();
    for (const double t : log.t) rows.push_back(command.at(t));
  }
  return out;
}

Samples at_rows(const FlightLog& log, const std::vector<double>& load, std::span<const std::size_t> rows,
                std::size_t stride = 1) {
  Samples s;
  for (std::size_t k = 0; k < rows.size(); k += stride)
    s.t.push_back(log.t[rows[k]]), s.v.push_back(log.vbat[rows[k]]), s.load.push_back(load[rows[k]]);
  return s;
}

// Rows without those where the voltage is elsewhere for a sample or two: what is there is no noise.
std::vector<std::size_t> without_glitches(const FlightLog& log, const std::vector<std::size_t>& rows) {
  constexpr std::size_t kBeside = 2;
  constexpr double kFar = 8.0, kLeastVoltage = 0.02;  // deviations; share of the voltage
  std::vector<double> off(rows.size()), size;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::vector<double> about;
    const std::size_t from = k < kBeside ? 0 : k - kBeside, to = std::min(k + kBeside + 1, rows.size());
    for (std::size_t i = from; i < to; ++i) about.push_back(log.vbat[rows[i]]);
    off[k] = std::abs(log.vbat[rows[k]] / median(about) - 1);
  }
  const double most = std::max(kFar * 1.48 * median(off), kLeastVoltage);
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (off[k] < most) out.push_back(rows[k]);
  return out;
}

}  // namespace

std::vector<double> quiet_voltage(const FlightLog& log) {
  if (log.vbat.empty() || !log.has_commands()) return log.vbat;
  auto [rows, apart] = new_samples(log.t, std::span(&log.vbat, 1));
  std::erase_if(rows, [&](std::size_t row) { return !(log.vbat[row] > 0); });
  rows = without_glitches(log, rows);
  if (rows.size() < kFewestVoltages || !(apart > 0)) return log.vbat;
  const std::size_t stride = 1 + rows.size() / kEnough;
  const std::vector<Track> commands = commands_at_rows(log);
  double least = INFINITY, lag = 0, walk = kFastest, R = 0;
  for (const double tried : kLags) {
    const Samples some = at_rows(log, load_of(log, commands, tried), rows, stride);
    for (double fast = kSlowest; fast <= kFastest; fast *= kStep) {
      const Innovations seen(some, fast / apart);
      if (const double surprise = seen.surprise(); surprise < least)
        least = surprise, lag = tried, walk = fast, R = seen.resistance();
    }
  }
  const bool quiet = walk > kFast, often = 2 * rows.size() > log.rows();
  if (quiet && (often || R == 0)) return log.vbat;
  const Track load = load_of(log, commands, lag);
  const Samples all = at_rows(log, load, rows);
  Track level = quiet ? all.v : smoothed(all, R, walk / apart);
  for (std::size_t k = 0; k < rows.size() && quiet; ++k) level[k] += R * all.load[k];
  Track out(log.rows(), kNaN);
  for (std::size_t k = 0; k < rows.size(); ++k) out[rows[k]] = level[k];
  out = interpolated(log.t, out);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= R * load[i];
  return out;
}

}  // namespace ident
