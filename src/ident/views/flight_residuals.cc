// Collects the smoother's residuals by channel and draws them by sensor, with the pictures of the bench fits.
#include "ident/views/flight_residuals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/flight/record/channel_units.h"
#include "ident/plots/residual_plots.h"
#include "ident/plots/spectrum_plot.h"

namespace ident {
namespace {

using Style = Series::Style;

constexpr std::size_t kFewest = 32;  // samples of which something can be said

struct ChannelResidual {
  std::string name;
  std::vector<double> t, r;  ///< of the first log: measured minus fitted, in standard deviations
  double square = 0, beyond = 0, next = 0, count = 0;  ///< of all logs
};

struct Sensor {
  const char *title, *id;
  int first, channels;
};
constexpr std::array<Sensor, 6> kSensors{{{"body rates", "rates", kGyro, 3},
                                          {"specific force", "force", kForce, 3},
                                          {"attitude", "attitude", kAttitude, 3},
                                          {"velocity", "velocity", kVelocity, 3},
                                          {"position", "position", kPosition, 3},
                                          {"rotor speeds", "rotors", kRotorChannel, kMaxRotors}}};

std::vector<ChannelResidual> residuals_by_channel(const FlightRecord& record, FlightSmoother& smoother) {
  std::vector<ChannelResidual> out(kChannels);
  const auto weighted = smoother.residuals();
  std::array<double, kChannels> last{};
  int arc_before = -1;
  for (std::size_t k = 0; k < weighted.size(); ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    if (place.arc != arc_before) last.fill(0.0);
    arc_before = place.arc;
    for (std::size_t i = 0; i < place.end - place.begin; ++i)
      for (std::size_t c = 0; c < kChannels; ++c) {
        const double r = -weighted[k][i * kChannels + c];
        if (!std::isfinite(r)) continue;
        ChannelResidual& channel = out[c];
        channel.square += r * r, channel.beyond += std::abs(r) > 3, channel.count += 1;
        channel.next += r * last[c], last[c] = r;
        if (arc.log != 0) continue;
        channel.t.push_back(arc.t[place.begin + i]), channel.r.push_back(r);
      }
  }
  for (int c = 0; c < kChannels; ++c) out[static_cast<std::size_t>(c)].name = channel_name(c);
  return out;
}

Table channel_table(const std::vector<ChannelResidual>& channels) {
  Table table{
      .title = "Residuals by channel",
      .columns = {"channel", "rms [noise]", "beyond 3 sigma [%]", "autocorrelation at lag 1", "bound"}};
  for (const ChannelResidual& channel : channels) {
    if (channel.count < kFewest) continue;
    table.rows.push_back({channel.name, format_number(std::sqrt(channel.square / channel.count), 3),
                          format_number(100 * channel.beyond / channel.count, 2),
                          format_number(channel.next / std::max(channel.square, 1e-300), 2),
                          format_number(1.96 / std::sqrt(channel.count), 2)});
  }
  return table;
}

double usual_step(const std::vector<double>& t) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  std::ranges::nth_element(steps, steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2));
  return steps[steps.size() / 2];
}

// What `draw` makes of each channel, in one picture; of what is common to all (bounds, the normal
// distribution) the first is kept, in grey.
template <class Draw>
Plot together(const std::vector<const ChannelResidual*>& channels, const Sensor& sensor,
              const std::string& title, Style style, Draw draw) {
  Plot out;
  std::vector<Series> common;
  for (const ChannelResidual* channel : channels) {
    Plot one = draw(*channel);
    std::vector<Series> series = std::move(one.series);
    if (channel == channels.front()) {
      out = one;
      out.id = fmt::format("residual-{}{}", sensor.id, one.id), out.title = title + sensor.title;
    }
    for (Series& s : series) {
      if (s.name == channel->name + " residual" || s.name == "as they are") {
        s.name = channel->name + " residual", s.style = style;
        out.series.push_back(std::move(s));
      } else if (channel == channels.front()) {
        if (s.style == Style::line) s.style = Style::measured;
        common.push_back(std::move(s));
      }
    }
  }
  std::ranges::move(common, std::back_inserter(out.series));
  return out;
}

void add_pictures(Section& section, const Sensor& sensor,
                  const std::vector<const ChannelResidual*>& channels) {
  const auto names = [](const ChannelResidual& c) { return ResidualNames{.channel = c.name, .unit = "-"}; };
  const auto add = [&](const std::string& title, Style style, auto draw) {
    section.plots.push_back(together(channels, sensor, title, style, draw));
  };
  add("Residuals over time: ", Style::line, [&](const ChannelResidual& c) {
    Plot plot = residual_plot(names(c), c.t, "time [s]", c.r, std::vector<bool>(c.r.size(), false));
    plot.kind = Plot::Kind::time_series, plot.y_label = "residual over noise [-]", plot.caption.clear();
    return plot;
  });
  add("Distribution: ", Style::line, [&](const ChannelResidual& c) { return histogram_plot(names(c), c.r); });
  add("Against the normal distribution: ", Style::points,
      [&](const ChannelResidual& c) { return normal_quantile_plot(names(c), c.r); });
  add("Autocorrelation: ", Style::line,
      [&](const ChannelResidual& c) { return autocorrelation_plot(names(c), c.r); });
  add("Spectrum: ", Style::line, [&](const ChannelResidual& c) {
    Plot plot = spectrum_plot(names(c), c.r, usual_step(c.t));
    plot.y_label = "density [1/Hz]";
    return plot;
  });
}

}  // namespace

Section flight_residuals(const FlightRecord& record, const FlightFit& fit) {
  const std::vector<ChannelResidual> all = residuals_by_channel(record, *fit.smoother);
  Section section{.title = "Residuals of the fit",
                  .text =
                      "Measured minus fitted, in units of the noise found. The fit may push the vehicle "
                      "from outside, so what the model lacks at low frequency is not here but among the "
                      "accelerations from outside. A bound holds 95 % of what white noise would give." +
                      std::string(record.logs > 1 ? " Pictures are of the first log, the table of all." : ""),
                  .tables = {channel_table(all)}};
  for (const Sensor& sensor : kSensors) {
    std::vector<const ChannelResidual*> channels;
    for (int c = sensor.first; c < sensor.first + sensor.channels; ++c)
      if (const ChannelResidual& channel = all[static_cast<std::size_t>(c)]; channel.r.size() >= kFewest)
        channels.push_back(&channel);
    if (!channels.empty()) add_pictures(section, sensor, channels);
  }
  return section;
}

Section outside_accelerations(const FlightRecord& record, const FlightFit& fit) {
  Section section{
      .title = "Accelerations from outside",
      .text =
          "What the fit needed beyond the model to follow the flight: gusts, and what the model lacks "
          "(then `ident gap` names it). The band holds 3 standard deviations of the process noise "
          "found."};
  const FlightSmoother& smoother = *fit.smoother;
  const AirNoise& air = fit.noise.in_log(0);
  const auto add = [&](const char* id, const char* title, const char* y_label,
                       const std::array<ColouredNoise, 3>& noise, auto&& of) {
    static constexpr std::array names = {"x", "y", "z"};
    Plot plot{
        .id = id, .title = title, .x_label = "time [s]", .y_label = y_label, .kind = Plot::Kind::time_series};
    std::array<Series, 3> traces;
    double widest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      traces[i].name = names[i], widest = std::max(widest, noise[i].sigma);
      for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
        const ChunkPlace& place = smoother.chunks()[k];
        const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
        if (arc.log != 0) continue;
        traces[i].x.push_back(arc.t[place.begin]), traces[i].y.push_back(of(smoother.states()[k], i));
      }
    }
    const std::size_t n = traces[0].x.size();
    Series band{.name = "3 sigma",
                .x = traces[0].x,
                .y = std::vector<double>(n, -3 * widest),
                .y2 = std::vector<double>(n, 3 * widest),
                .style = Style::band};
    plot.series = {std::move(band), std::move(traces[0]), std::move(traces[1]), std::move(traces[2])};
    section.plots.push_back(std::move(plot));
  };
  using State = FlightState<double>;
  if (record.layout.w_dot >= 0)
    add("outside-turn", "Angular acceleration from outside, body frame", "acceleration [rad/s^2]", air.w_dot,
        [](const State& x, std::size_t i) { return x.outside.w_dot_B[static_cast<Eigen::Index>(i)]; });
  if (record.layout.v_dot >= 0)
    add("outside-push",
        fit.noise.axes == GustAxes::world ? "Acceleration from outside, world frame"
                                          : "Acceleration from outside, body frame",
        "acceleration [m/s^2]", air.v_dot,
        [](const State& x, std::size_t i) { return x.outside.v_dot[static_cast<Eigen::Index>(i)]; });
  const auto add_shown = [&](std::size_t g, const char* id, const char* title, const char* y_label) {
    constexpr double kNothing = 1e-6;  // rad, m/s, m: none was found
    const auto sigma_of = [](const ColouredNoise& axis) { return axis.sigma; };
    if (record.layout.shown_error[g] >= 0 &&
        std::ranges::max(fit.noise.slow[g], {}, sigma_of).sigma > kNothing)
      add(id, title, y_label, fit.noise.slow[g],
          [g](const State& x, std::size_t i) { return x.shown_error[g][static_cast<Eigen::Index>(i)]; });
  };
  add_shown(kShownAttitude, "attitude-error", "Slow error of the attitude as shown, body frame",
            "angle [rad]");
  add_shown(kShownVelocity, "velocity-error", "Slow error of the velocity as shown, world frame",
            "speed [m/s]");
  add_shown(kShownPosition, "position-error", "Slow error of the position as shown, world frame",
            "distance [m]");
  return section;
}

}  // namespace ident
