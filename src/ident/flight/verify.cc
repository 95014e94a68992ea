// Verification as in [Phang] section 5: short open-loop simulations against the log, channel by channel.
#include "ident/flight/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/core/stage_times.h"
#include "ident/flight/checks/log_self_test.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/prepare.h"
#include "ident/flight/record/channel_units.h"
#include "ident/flight/refine_trim.h"
#include "ident/result/json_number.h"
#include "ident/views/data_health.h"

namespace ident {
namespace {

// Of one channel over all windows.
class Agreement {
 public:
  void add(double measured, double simulated) {
    const double error = simulated - measured;
    error2_ += error * error, measured2_ += measured * measured, simulated2_ += simulated * simulated;
    sum_ += measured, n_ += 1;
  }
  bool enough() const { return n_ >= 2; }
  double rms() const { return std::sqrt(error2_ / n_); }
  double fit_percent() const {
    const double variance = measured2_ - sum_ * sum_ / n_;
    return 100 * (1 - std::sqrt(error2_ / std::max(variance, 1e-300)));
  }
  /// Theil's inequality coefficient.
  double theil() const { return std::sqrt(error2_) / (std::sqrt(measured2_) + std::sqrt(simulated2_)); }

 private:
  double error2_ = 0, measured2_ = 0, simulated2_ = 0, sum_ = 0, n_ = 0;
};

// Simulations from the starts of all windows beside what was measured; pictures are of the first log.
struct Simulated {
  std::array<Agreement, kChannels> agreement;
  std::array<Series, kChannels> measured, simulated;
  std::size_t windows = 0, ran_away = 0;
};

bool is_angle(std::size_t channel) { return channel >= kAttitude && channel < kVelocity; }

// Beyond this many times what a channel ever showed a simulation says nothing more of the flight.
constexpr double kRunAway = 100.0;

// Whether a simulated window ran away: `residuals` of its rows, weighted; `largest` of each channel.
bool is_lost(const std::vector<double>& residuals, const FlightArc& arc, const ChunkPlace& place,
             const NoiseModel& noise, const std::array<double, kChannels>& largest) {
  for (std::size_t i = place.begin; i < place.end; ++i)
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (!std::isfinite(arc.y[i * kChannels + c])) continue;
      const double r = residuals[(i - place.begin) * kChannels + c] * noise.sigma[c];
      // An angle is never off by more than a turn.
      if (!std::isfinite(r) || (!is_angle(c) && std::abs(r) > kRunAway * largest[c])) return true;
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

NoiseModel without_gusts(NoiseModel noise) {
  for (AirNoise& air : noise.air)
    for (std::size_t i = 0; i < 3; ++i) air.w_dot[i].sigma = air.v_dot[i].sigma = 0.0;
  noise.slow = {};
  return noise;
}

// States at the start of every window come from the log itself; the constants stay as stated.
Simulated simulated_windows(const FlightRecord& record, const Theta& theta, const NoiseModel& noise,
                            double horizon) {
  FlightSmoother smoother(record, theta, noise, horizon);
  smoother.set_noise(without_gusts(noise));
  smoother.unlink();
  smoother.settle(Eigen::VectorXd::Zero(theta.size()), 4);
  const auto residuals = smoother.residuals();
  const std::array<double, kChannels> largest = largest_of(record);
  Simulated found{.windows = smoother.chunks().size()};
  for (std::size_t k = 0; k < found.windows; ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    if (is_lost(residuals[k], arc, place, noise, largest)) {
      found.ran_away += 1;
      continue;
    }
    for (std::size_t i = place.begin; i < place.end; ++i)
      for (std::size_t c = 0; c < kChannels; ++c) {
        const double r = residuals[k][(i - place.begin) * kChannels + c] * noise.sigma[c];
        if (!std::isfinite(r)) continue;
        const double y = arc.y[i * kChannels + c];
        found.agreement[c].add(y, y + r);
        if (arc.log != 0) continue;
        found.measured[c].x.push_back(arc.t[i]), found.measured[c].y.push_back(y);
        found.simulated[c].x.push_back(arc.t[i]), found.simulated[c].y.push_back(y + r);
      }
  }
  return found;
}

Plot picture(std::size_t channel, Series measured, Series simulated) {
  const std::string name = channel_name(static_cast<int>(channel));
  measured.name = "measured", measured.style = Series::Style::measured;
  simulated.name = "simulated", simulated.style = Series::Style::predicted;
  Plot plot;
  plot.id = "verify_" + std::to_string(channel);
  plot.title = name + ", measured and simulated";
  plot.x_label = "time [s]", plot.y_label = name + " [" + channel_unit(static_cast<int>(channel)) + "]";
  plot.kind = Plot::Kind::time_series;
  plot.series = {std::move(measured), std::move(simulated)};
  return plot;
}

// What a channel's row says. An angle has no zero to be measured from: neither fit nor Theil's coefficient.
struct ChannelFigures {
  std::string name, unit;
  double rms, fit_percent, theil;

  ChannelFigures(std::size_t c, const Agreement& agreement)
      : name(channel_name(static_cast<int>(c))),
        unit(channel_unit(static_cast<int>(c))),
        rms(agreement.rms()),
        fit_percent(is_angle(c) ? kNaN : agreement.fit_percent()),
        theil(is_angle(c) ? kNaN : agreement.theil()) {}
};

nlohmann::ordered_json as_json(const std::vector<ChannelFigures>& channels) {
  nlohmann::ordered_json j;
  for (const ChannelFigures& c : channels)
    j[c.name] = {{"rms", c.rms},
                 {"unit", c.unit},
                 {"fit_percent", number_or_null(c.fit_percent)},
                 {"theil", number_or_null(c.theil)}};
  return j;
}

Section as_section(const std::vector<ChannelFigures>& channels, const Simulated& found, double horizon,
                   bool several_logs) {
  Section section;
  section.title = "Simulated against measured";
  section.text =
      fmt::format("Open-loop simulations of {:.2g} s each, started at states fitted to the log.", horizon);
  if (several_logs) section.text += " Pictures are of the first log, the table of all.";
  Table table{"", {"channel", "RMS error", "unit", "fit %", "Theil U"}, {}};
  for (const ChannelFigures& c : channels)
    table.rows.push_back({c.name, format_number(c.rms, 3), c.unit, format_number(c.fit_percent, 3),
                          format_number(c.theil, 3)});
  section.tables.push_back(table);
  for (std::size_t c = 0; c < kChannels; ++c)
    if (found.agreement[c].enough() && !is_angle(c))
      section.plots.push_back(picture(c, found.measured[c], found.simulated[c]));
  return section;
}

std::string in_words(const Simulated& found, double seconds, double horizon) {
  std::string text = fmt::format(
      "The model as stated was run against {:.0f} s of flight in windows of {:.2g} s.", seconds, horizon);
  if (found.ran_away > 0)
    text += fmt::format(
        " {} of the {} simulations ran away from the flight altogether; the errors below are those of the "
        "others.",
        found.ran_away, found.windows);
  return text;
}

}  // namespace

Result verify_flight(const Vehicle& vehicle, std::span<const FlightLog> logs, double horizon) {
  const Stage stage("simulation of the logs");
  Result result;
  result.command = "flightlog";
  auto [p, record, tested, vibration] = enter_flight(vehicle, logs, result);
  for (FlightArc& arc : record.arcs) arc.speed_errors = nullptr;  // nothing but the model pushes here
  const NoiseModel noise = initial_noise(record);
  if (only_trim(record.signals)) {
    verify_trim(result, record, p);
    result.sections.push_back(data_health(record, logs, noise, vibration));
  } else {
    const Theta theta(p, {}, record.logs, record.signals.rates);
    const Simulated found = simulated_windows(record, theta, noise, horizon);
    std::vector<ChannelFigures> channels;
    for (std::size_t c = 0; c < kChannels; ++c)
      if (found.agreement[c].enough()) channels.emplace_back(c, found.agreement[c]);
    result.fit = {{"channels", as_json(channels)},
                  {"horizon", horizon},
                  {"seconds", record.duration},
                  {"windows", found.windows},
                  {"ran_away", found.ran_away}};
    result.sections.push_back(data_health(record, logs, noise, vibration));
    result.sections.push_back(as_section(channels, found, horizon, record.logs > 1));
    result.verdict = in_words(found, record.duration, horizon);
  }
  if (const std::string wrong = disqualified(tested); !wrong.empty()) distrust(result, wrong);
  return result;
}

}  // namespace ident
