// Fills the pictures of a diagnosis from its JSON and the residual wrench.
#include "ident/gap/views/gap_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/core/format_number.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Json = nlohmann::ordered_json;
using Style = Series::Style;

constexpr double kWorthShowing = 0.005;  // probability
constexpr std::size_t kMostCauses = 12;

double number(const Json& j) { return j.is_number() ? j.get<double>() : kNaN; }

bool same(const ResidualWrench& a, const ResidualWrench& b) {
  return a.residual.rows() == b.residual.rows() && a.residual == b.residual;  // chunks may differ in length
}

Plot share_plot(std::string id, std::string title) {
  return {.id = std::move(id),
          .title = std::move(title),
          .caption = "What the noise of the sensors does not explain, shared out.",
          .y_label = "share [%]",
          .series = {{.name = "share", .style = Style::bars}}};
}

void add_bar(Plot& plot, const std::string& name, double height) {
  plot.series.front().x.push_back(static_cast<double>(plot.column_names.size()));
  plot.series.front().y.push_back(height);
  plot.column_names.push_back(name);
}

Series over_time(const ResidualWrench& w, Index channel, std::string name, Style style) {
  Series series{.name = std::move(name), .style = style};
  for (Index k = 0; k < w.residual.rows() && w.log[static_cast<std::size_t>(k)] == w.log.front(); ++k) {
    series.x.push_back(w.t[static_cast<std::size_t>(k)]);
    series.y.push_back(w.residual(k, channel));
  }
  return series;
}

Series over_regime(const ResidualWrench& w, Index channel, const std::string& variable, std::string name) {
  Series series{.name = std::move(name), .style = Style::points};
  const auto at = std::ranges::find(w.regimes, variable, &std::pair<std::string, VectorXd>::first);
  if (at == w.regimes.end()) return series;
  series.x.assign(at->second.begin(), at->second.end());
  for (Index k = 0; k < w.residual.rows(); ++k) series.y.push_back(w.residual(k, channel));
  return series;
}

std::string with_unit(const std::string& name, const std::string& unit) { return name + " [" + unit + "]"; }

}  // namespace

std::string channel_unit(const std::string& channel) {
  return channel.starts_with("F") ? "N" : channel.starts_with("M") ? "N m" : "rad/s^2";
}

std::string regime_unit(const std::string& variable) {
  if (variable == "airspeed" || variable == "climb") return "m/s";
  if (variable == "height") return "m";
  return variable == "tilt" ? "rad" : variable == "rates" ? "rad/s" : "-";
}

std::string band_name(const Json& band) {
  return fmt::format("{} to {} Hz", format_number(band["hz"][0], 2), format_number(band["hz"][1], 2));
}

Plot waterfall_plot(const Json& found, const std::string& causes) {
  const Json& gap = found["gap"];
  const double before = number(gap["before"]), after = number(gap["after"]);
  const double refitted = gap.contains("without_causes") ? number(gap["without_causes"]) : kNaN;
  Plot plot{.id = "waterfall",
            .title = "Prediction error over 0.5 s on held-out flight",
            .caption = "In units of the sensors' noise; a perfect model would still show the noise floor.",
            .y_label = "error over sensor noise [-]",
            .column_names = {"model as given"}};
  Series error{.name = "error", .x = {0}, .y = {before}, .style = Style::bars},
      change{.name = "change", .style = Style::bars}, floor{.name = "noise floor", .style = Style::bars};
  const auto column = [&](const std::string& name) {
    plot.column_names.push_back(name);
    return static_cast<double>(plot.column_names.size() - 1);
  };
  const auto step = [&](const std::string& name, double from, double to) {
    change.x.push_back(column(name)), change.y.push_back(to), change.y2.push_back(from);
  };
  const bool by_constants = !causes.empty() && std::isfinite(refitted);
  if (by_constants) step("constants refitted", before, refitted);
  step(causes.empty() ? "constants refitted" : causes, by_constants ? refitted : before, after);
  error.x.push_back(column("left")), error.y.push_back(after);
  floor.x.push_back(column("noise floor")), floor.y.push_back(number(gap["noise_floor"]));
  plot.series = {std::move(error), std::move(change), std::move(floor)};
  return plot;
}

Plot shares_plot(const Json& found) {
  Plot plot{
      .id = "shares",
      .title = "What each cause closes",
      .caption =
          "Of the squared error on held-out flight beyond the floor, constants refitted: Shapley values, "
          "with 95 % intervals over blocks of flight.",
      .y_label = "share [%]"};
  Series bars{.name = "share", .style = Style::bars}, steps{.name = "closed", .style = Style::bars},
      intervals{.name = "95 % interval", .style = Style::points};
  const auto column = [&](const std::string& name) {
    plot.column_names.push_back(name);
    return static_cast<double>(plot.column_names.size() - 1);
  };
  bars.x.push_back(column("without causes")), bars.y.push_back(100);
  double level = 100;
  const auto add_interval = [&](double x, double at, const Json& ci95) {
    intervals.x.push_back(x), intervals.y.push_back(at);
    intervals.y2.push_back(50 * (number(ci95[1]) - number(ci95[0])));
  };
  for (const Json& candidate : found["candidates"]) {
    const auto& named = found["verdict"]["effects"];
    if (std::ranges::find(named, candidate["effect"]) == named.end() || !candidate.contains("share") ||
        !candidate["share"].is_number())
      continue;
    const double x = column(candidate["effect"]), next = level - 100 * number(candidate["share"]);
    steps.x.push_back(x), steps.y.push_back(next), steps.y2.push_back(level);
    add_interval(x, next, candidate["share_ci95"]);
    level = next;
  }
  if (steps.x.empty()) return plot;
  const Json& left = found["verdict"]["remaining"];
  const double x = column("left");
  bars.x.push_back(x), bars.y.push_back(level);
  if (left.is_object()) add_interval(x, level, left["share_ci95"]);
  plot.series = {std::move(bars), std::move(steps), std::move(intervals)};
  return plot;
}

Plot channel_plot(const Json& where) {
  Plot plot = share_plot("channels", "Share of the force and moment channels");
  for (const Json& channel : where["channels"])
    add_bar(plot, channel["name"], 100 * number(channel["share"]));
  return plot;
}

Plot band_plot(const Json& where) {
  Plot plot = share_plot("bands", "Share of the frequency bands");
  for (const Json& band : where["bands"]) add_bar(plot, band_name(band), 100 * number(band["share"]));
  return plot;
}

Plot probability_plot(const Json& candidates) {
  Plot plot{.id = "probability",
            .title = "Probability that a cause is part of the gap",
            .caption = "Over all sets of causes; those below half a percent are in the table only.",
            .y_label = "probability [-]",
            .series = {{.name = "probability", .style = Style::bars}}};
  for (const Json& candidate : candidates)
    if (number(candidate["probability"]) > kWorthShowing && plot.column_names.size() < kMostCauses)
      add_bar(plot, candidate["effect"], number(candidate["probability"]));
  if (plot.column_names.size() < 2) plot.series.clear();  // one bar says no more than the table
  return plot;
}

Plot residual_over_time(const ResidualWrench& before, const ResidualWrench& after, Index channel) {
  const std::string& name = before.names[static_cast<std::size_t>(channel)];
  Plot plot{.id = "residual-" + name,
            .title = "Residual " + name,
            .x_label = "time [s]",
            .y_label = with_unit(name, channel_unit(name)),
            .kind = Plot::Kind::time_series};
  if (same(before, after))
    plot.series = {over_time(before, channel, name + " residual", Style::line)};
  else
    plot.series = {over_time(before, channel, name + ", model as given", Style::measured),
                   over_time(after, channel, name + ", with the causes", Style::line)};
  return plot;
}

Plot residual_over_regime(const ResidualWrench& before, const ResidualWrench& after, Index channel,
                          const std::string& variable) {
  const std::string& name = before.names[static_cast<std::size_t>(channel)];
  Plot plot{.id = "residual-" + name + "-over-" + variable,
            .title = "Residual " + name + " over " + variable,
            .caption = "A missing effect shows as a shape; what remains with the causes should have none.",
            .x_label = with_unit(variable, regime_unit(variable)),
            .y_label = with_unit(name, channel_unit(name)),
            .series = {over_regime(before, channel, variable, "model as given")}};
  if (!same(before, after)) plot.series.push_back(over_regime(after, channel, variable, "with the causes"));
  return plot;
}

}  // namespace ident
