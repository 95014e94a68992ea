// Evaluates the windows of one log and puts them end to end.
#include "ident/views/prediction_traces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/flight/fit/prediction_windows.h"
#include "ident/flight/record/channel_units.h"
#include "ident/flight/record/excerpts.h"

namespace ident {
namespace {

using Style = Series::Style;

bool has_number(int channel) { return channel < kAttitude || channel >= kVelocity; }

FlightRecord first_log_of(const FlightRecord& record) {
  FlightRecord out = without_arcs(record);
  for (const FlightArc& arc : record.arcs)
    if (arc.log == record.arcs.front().log) out.arcs.push_back(arc);
  return out;
}

// Predicted minus measured at the rows of every window, in units of the noise.
std::vector<ChunkResult> predicted(const FlightWindows& windows, double horizon) {
  std::vector<ChunkResult> results(windows.size());
  windows.in_parallel([&](std::size_t w) {
    ChunkTask task = windows.task(w, horizon);
    task.end = std::min(task.end, task.rows - 1);
    task.jacobian = false;
    if (task.end > task.begin) evaluate_chunk(task, results[w]);
  });
  return results;
}

// A gap after each window keeps the line from running on into the next; a row that both have goes to the
// next.
Series trace_of(const FlightRecord& record, const FlightWindows& windows,
                const std::vector<ChunkResult>& results, std::size_t channel, double sigma) {
  Series out;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const FlightArc& arc = record.arcs[windows[w].arc];
    bool shared = false;
    while (w > 0 && windows[w].arc == windows[w - 1].arc && !out.x.empty() &&
           out.x.back() >= arc.t[windows[w].row])
      out.x.pop_back(), out.y.pop_back(), shared = true;
    if (shared && !out.x.empty())
      out.x.push_back((out.x.back() + arc.t[windows[w].row]) / 2), out.y.push_back(kNaN);
    for (std::size_t i = 0; i * kChannels < results[w].residuals.size(); ++i) {
      const std::size_t row = windows[w].row + i;
      const double r = results[w].residuals[i * kChannels + channel];
      if (!std::isfinite(r)) continue;
      out.x.push_back(arc.t[row]), out.y.push_back(arc.y[row * kChannels + channel] + r * sigma);
    }
    if (out.x.empty()) continue;
    out.x.push_back(out.x.back() + record.interval / 2), out.y.push_back(kNaN);
  }
  return out;
}

Series measured_trace(const FlightRecord& record, std::size_t channel) {
  Series out{.name = "measured", .style = Style::measured};
  for (const FlightArc& arc : record.arcs) {
    if (!out.x.empty()) out.x.push_back((out.x.back() + arc.t.front()) / 2), out.y.push_back(kNaN);
    for (std::size_t i = 0; i < arc.rows(); ++i)
      if (const double y = arc.y[i * kChannels + channel]; std::isfinite(y))
        out.x.push_back(arc.t[i]), out.y.push_back(y);
  }
  return out;
}

}  // namespace

std::vector<int> channels_that_gain(const std::vector<PredictionWindow>& before,
                                    const std::vector<PredictionWindow>& after) {
  std::vector<std::pair<double, int>> gains;
  for (int channel = 0; channel < kChannels; ++channel) {
    const auto c = static_cast<std::size_t>(channel);
    double gain = 0;
    for (std::size_t w = 0; w < std::min(before.size(), after.size()); ++w)
      if (before[w].count[c] > 0) gain += (before[w].square[c] - after[w].square[c]) / before[w].count[c];
    if (gain > 0 && has_number(channel)) gains.emplace_back(-gain, channel);
  }
  std::ranges::sort(gains);
  std::vector<int> channels;
  channels.reserve(gains.size());
  for (const auto& [gain, channel] : gains) channels.push_back(channel);
  return channels;
}

std::vector<Plot> prediction_traces(const FlightRecord& record, const TracedModel& before,
                                    const TracedModel& after, const NoiseModel& noise,
                                    const std::vector<int>& channels, const std::vector<double>& horizons) {
  std::vector<Plot> plots;
  if (record.arcs.empty() || channels.empty()) return plots;
  const FlightRecord shown = first_log_of(record);
  for (const double horizon : horizons) {
    const WindowOptions options{.spacing = horizon, .shortest = horizon / 2};
    const FlightWindows old_windows(shown, *before.theta, before.u, noise, options),
        new_windows(shown, *after.theta, after.u, noise, options);
    const std::vector<ChunkResult> old_results = predicted(old_windows, horizon),
                                   new_results = predicted(new_windows, horizon);
    for (const int channel : channels) {
      const auto c = static_cast<std::size_t>(channel);
      const std::string name = channel_name(channel);
      Series given = trace_of(shown, old_windows, old_results, c, noise.sigma[c]);
      given.name = before.name, given.style = Style::line;
      Series found = trace_of(shown, new_windows, new_results, c, noise.sigma[c]);
      found.name = after.name, found.style = Style::predicted;
      plots.push_back({.id = fmt::format("held-out-{}-{}", name, format_number(horizon)),
                       .title = fmt::format("{}, predicted {} s ahead", name, format_number(horizon)),
                       .caption = "Each piece starts from a state estimated out of the past only; then the "
                                  "model is on its own.",
                       .x_label = "time [s]",
                       .y_label = name + " [" + channel_unit(channel) + "]",
                       .kind = Plot::Kind::time_series,
                       .series = {measured_trace(shown, c), std::move(given), std::move(found)}});
    }
  }
  return plots;
}

}  // namespace ident
