// Verification as in [Phang] section 5: short open-loop simulations against the log, channel by channel.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/estimators/flight_channels.h"
#include "ident/estimators/flight_entry.h"
#include "ident/estimators/flight_refine.h"
#include "ident/estimators/flight_self_test.h"
#include "ident/estimators/flight_trim.h"

namespace ident {
namespace {

struct Sums {
  double error2 = 0, measured2 = 0, simulated2 = 0, mean = 0, spread2 = 0, n = 0;
};

// Beyond this many times what a channel ever showed a simulation says nothing more of the flight.
constexpr double kRunAway = 100.0;

// Whether a simulated window ran away: `residuals` of its rows, weighted; `largest` of each channel.
bool is_lost(const std::vector<double>& residuals, const FlightArc& arc, const ChunkPlace& place,
             const NoiseModel& noise, const std::array<double, kChannels>& largest) {
  for (std::size_t i = place.begin; i < place.end; ++i)
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (!std::isfinite(arc.y[i * kChannels + c])) continue;
      const double r = residuals[(i - place.begin) * kChannels + c] * noise.sigma[c];
      const bool angle = c >= kAttitude && c < kVelocity;  // never more than a turn
      if (!std::isfinite(r) || (!angle && std::abs(r) > kRunAway * largest[c])) return true;
    }
  return false;
}

// The same for all axes of a sensor: one along which nothing happened says nothing of its size.
std::array<double, kChannels> largest_of(const FlightRecord& record) {
  std::array<double, kChannels> largest{};
  const auto of_sensor = [&](std::size_t first, std::size_t count) {
    double most = 0;
    for (const FlightArc& arc : record.arcs)
      for (std::size_t i = 0; i < arc.rows(); ++i)
        for (std::size_t c = first; c < first + count; ++c)
          if (const double y = arc.y[i * kChannels + c]; std::isfinite(y)) most = std::max(most, std::abs(y));
    std::fill_n(largest.begin() + static_cast<std::ptrdiff_t>(first), count, most);
  };
  for (const std::size_t sensor :
       {std::size_t{kGyro}, std::size_t{kForce}, std::size_t{kVelocity}, std::size_t{kPosition}})
    of_sensor(sensor, 3);
  of_sensor(kRotorChannel, kMaxRotors);
  return largest;
}

}  // namespace

Result verify_flight(const Vehicle& vehicle, std::span<const FlightLog> logs, double horizon) {
  Result result;
  result.command = "flightlog";
  auto [p, record, tested, vibration] = enter_flight(vehicle, logs, result);
  for (FlightArc& arc : record.arcs) arc.speed_errors = nullptr;  // nothing but the model pushes here
  if (only_trim(record.signals)) {
    verify_trim(result, record, p);
    result.sections.push_back(data_health(record, logs, initial_noise(record), vibration));
    if (const std::string wrong = disqualified(tested); !wrong.empty()) distrust(result, wrong);
    return result;
  }
  const Theta theta(p, {}, record.logs, record.signals.rates);
  // States at the start of every window, from the log itself; the constants stay as stated.
  const NoiseModel noise = initial_noise(record);
  FlightSmoother smoother(record, theta, noise, horizon);
  NoiseModel calm = noise;
  for (AirNoise& air : calm.air)
    for (std::size_t i = 0; i < 3; ++i) air.w_dot[i].sigma = air.v_dot[i].sigma = 0.0;
  calm.slow = {};
  smoother.set_noise(calm);
  smoother.unlink();
  smoother.settle(Eigen::VectorXd::Zero(theta.size()), 4);
  const auto residuals = smoother.residuals();
  const std::array<double, kChannels> largest = largest_of(record);
  std::size_t ran_away = 0;
  std::array<Sums, kChannels> sums;
  std::array<Series, kChannels> measured, simulated;
  for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    if (is_lost(residuals[k], arc, place, noise, largest)) {
      ran_away += 1;
      continue;
    }
    for (std::size_t i = place.begin; i < place.end; ++i) {
      for (std::size_t c = 0; c < kChannels; ++c) {
        const double r = residuals[k][(i - place.begin) * kChannels + c] * noise.sigma[c];
        if (!std::isfinite(r)) continue;
        const double y = arc.y[i * kChannels + c];
        Sums& s = sums[c];
        s.error2 += r * r, s.measured2 += y * y, s.simulated2 += (y + r) * (y + r), s.mean += y, s.n += 1;
        s.spread2 += y * y;
        if (arc.log == 0) {
          measured[c].x.push_back(arc.t[i]), measured[c].y.push_back(y);
          simulated[c].x.push_back(arc.t[i]), simulated[c].y.push_back(y + r);
        }
      }
    }
  }
  Section section;
  section.title = "Simulated against measured";
  section.text =
      fmt::format("Open-loop simulations of {:.2g} s each, started at states fitted to the log.", horizon);
  if (record.logs > 1) section.text += " Pictures are of the first log, the table of all.";
  Table table{"", {"channel", "RMS error", "unit", "fit %", "Theil U"}, {}};
  nlohmann::ordered_json channels;
  for (std::size_t c = 0; c < kChannels; ++c) {
    const Sums& s = sums[c];
    if (s.n < 2) continue;
    const int channel = static_cast<int>(c);
    const double rms = std::sqrt(s.error2 / s.n), variance = s.spread2 - s.mean * s.mean / s.n;
    const bool angle = channel >= kAttitude && channel < kVelocity;
    const double fit = angle ? kNaN : 100 * (1 - std::sqrt(s.error2 / std::max(variance, 1e-300)));
    const double theil =
        angle ? kNaN : std::sqrt(s.error2) / (std::sqrt(s.measured2) + std::sqrt(s.simulated2));
    table.rows.push_back({channel_name(channel), format_number(rms, 3), channel_unit(channel),
                          format_number(fit, 3), format_number(theil, 3)});
    nlohmann::ordered_json j{{"rms", rms}, {"unit", channel_unit(channel)}};
    j["fit_percent"] = std::isfinite(fit) ? nlohmann::ordered_json(fit) : nlohmann::ordered_json(nullptr);
    j["theil"] = std::isfinite(theil) ? nlohmann::ordered_json(theil) : nlohmann::ordered_json(nullptr);
    channels[channel_name(channel)] = j;
    if (angle) continue;
    Plot plot;
    plot.id = "verify_" + std::to_string(c);
    plot.title = channel_name(channel) + ", measured and simulated";
    plot.x_label = "time [s]", plot.y_label = channel_name(channel) + " [" + channel_unit(channel) + "]";
    plot.kind = Plot::Kind::time_series;
    measured[c].name = "measured", measured[c].style = Series::Style::measured;
    simulated[c].name = "simulated", simulated[c].style = Series::Style::predicted;
    plot.series = {measured[c], simulated[c]};
    section.plots.push_back(plot);
  }
  section.tables.push_back(table);
  result.fit["channels"] = channels;
  result.fit["horizon"] = horizon;
  result.fit["seconds"] = record.duration;
  result.fit["windows"] = smoother.chunks().size();
  result.fit["ran_away"] = ran_away;
  result.sections.push_back(data_health(record, logs, noise, vibration));
  result.sections.push_back(section);
  result.verdict =
      fmt::format("The model as stated was run against {:.0f} s of flight in windows of {:.2g} s.",
                  record.duration, horizon);
  if (ran_away > 0)
    result.verdict += fmt::format(
        " {} of the {} simulations ran away from the flight altogether; the errors below are those of the "
        "others.",
        ran_away, smoother.chunks().size());
  if (const std::string wrong = disqualified(tested); !wrong.empty()) distrust(result, wrong);
  return result;
}

}  // namespace ident
