// Fit over data, residuals over speed and row, their distribution and colour.
#include "ident/bench/thrust/thrust_sweep_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/plots/residual_plots.h"

namespace ident {
namespace {

using Style = Series::Style;
constexpr int kCurvePoints = 60;

std::string with_std(const LeastSquaresFit& fit, const char* name) {
  return format_with_uncertainty(fit.value(name), fit.std(name));
}

/// Points, the quadratic law and the one with a linear term, over speed.
Plot fit_plot(const SweepFile& file, const SweepChannel& channel, const std::vector<bool>& rejected,
              const char* constant, const std::string& id) {
  Series points{.name = channel.name + " measured", .style = Style::points}, quadratic{.name = "k Omega^2"},
      linear{.name = "a + b Omega + c Omega^2"}, out{.name = "left out", .style = Style::points};
  const double scale = channel.full_scale();
  double top = 0.0;
  for (std::size_t i = 0; i < channel.moving.size(); ++i) {
    const SweepPoint& p = channel.moving[i];
    top = std::max(top, p.Omega);
    if (rejected[i] && std::abs(p.value) > 2 * scale) continue;  // it would hide all else
    Series& series = rejected[i] ? out : points;
    series.x.push_back(p.Omega), series.y.push_back(p.value);
  }
  const LeastSquaresFit &fit = file.fit.fit, &bent = file.linear.fit;
  const double tare = fit.value(channel.name + "_tare");
  const double offset = channel.rest.empty() ? 0.0 : bent.value(channel.name + "_offset");
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double w = top * i / kCurvePoints;
    quadratic.x.push_back(w);
    quadratic.y.push_back(tare + fit.value(constant) * w * w);
    linear.x.push_back(w);
    linear.y.push_back(bent.value(channel.name + "_tare") + offset + bent.value(channel.name + "_slope") * w +
                       bent.value(constant) * w * w);
  }
  Plot plot{.id = id + "-fit",
            .title = channel.name + " over rotor speed",
            .x_label = "rotor speed [rad/s]",
            .y_label = fmt::format("{} [{}]", channel.name, channel.unit),
            .series = {points, quadratic, linear}};
  if (!out.x.empty()) plot.series.push_back(std::move(out));
  return plot;
}

void add_channel_plots(const SweepFile& file, const SweepChannel& channel, const ChannelResiduals& residuals,
                       const char* constant, std::size_t number, std::vector<Plot>& plots) {
  const std::string id = fmt::format("thrust-{}-{}", number, channel.name);
  const ResidualNames names{.id = id, .channel = channel.name, .unit = channel.unit};
  std::vector<double> place;
  for (const SweepPoint& p : channel.moving) place.push_back(p.place);
  plots.push_back(fit_plot(file, channel, residuals.rejected, constant, id));
  plots.push_back(
      residual_plot(names, residuals.Omega, "rotor speed [rad/s]", residuals.residual, residuals.rejected));
  plots.push_back(residual_plot(names, place, file.rows.is_log ? "time [s]" : "row", residuals.residual,
                                residuals.rejected));
  if (residuals.residual.size() < 8) return;
  plots.push_back(histogram_plot(names, residuals.standardized));
  plots.push_back(normal_quantile_plot(names, residuals.standardized));
  plots.push_back(autocorrelation_plot(names, residuals.residual, residuals.standardized));
}

Plot curve_plot(const CommandCurve& curve, std::size_t number) {
  Series points{.name = "Omega measured", .x = curve.delta, .y = curve.Omega, .style = Style::points};
  Series line{.name = "Omega_0 + km delta"};
  for (const double delta : {0.0, std::max(1.0, std::ranges::max(curve.delta))}) {
    line.x.push_back(delta);
    line.y.push_back(curve.fit.value("Omega_0") + curve.fit.value("km") * delta);
  }
  return {.id = fmt::format("thrust-{}-command", number),
          .title = "Rotor speed over command",
          .x_label = "command [-]",
          .y_label = "rotor speed [rad/s]",
          .series = {points, line}};
}

void add_law_row(Table& table, const SweepFile& file, const std::string& what, const LawJudgement& law) {
  table.rows.push_back({file.rows.file, what, fmt::format("{:.2f}", law.misfit_percent_fs),
                        fmt::format("{:.2f}", law.with_linear_term_percent_fs),
                        fmt::format("{:.2f}", law.noise_percent_fs), format_number(law.p_value, 2),
                        law.law_fails ? "bent" : "quadratic"});
}

}  // namespace

Table sweep_table(const std::vector<SweepFile>& files) {
  Table table{
      .title = "Files",
      .columns = {"file", "kT [N s^2/rad^2]", "kQ [N m s^2/rad^2]", "tare [N]", "points", "rows used"}};
  for (const SweepFile& file : files)
    table.rows.push_back(
        {file.rows.file, with_std(file.fit.fit, "kT"), file.has_torque() ? with_std(file.fit.fit, "kQ") : "",
         with_std(file.fit.fit, "thrust_tare"), fmt::format("{}", file.points.thrust.moving.size()),
         fmt::format("{} of {}", file.points.thrust.used, file.points.thrust.rows)});
  return table;
}

Table law_table(const std::vector<SweepFile>& files) {
  Table table{.title = "Quadratic law, in % of full scale",
              .columns = {"file", "force", "k Omega^2", "with linear term", "noise", "p", "verdict"}};
  for (const SweepFile& file : files) {
    add_law_row(table, file, "thrust", file.thrust_law);
    if (file.torque_law) add_law_row(table, file, "torque", *file.torque_law);
  }
  return table;
}

Section sweep_section(const SweepFile& file, std::size_t number) {
  Section section{.title = "Sweep " + file.rows.file};
  section.text = fmt::format("{} Speed from '{}'.",
                             file.points.averaged ? "Each point is the mean over a stretch of steady speed."
                                                  : "Each point is a row.",
                             file.rows.speed_column);
  add_channel_plots(file, file.points.thrust, file.fit.thrust, "kT", number, section.plots);
  if (file.has_torque())
    add_channel_plots(file, file.points.torque, file.fit.torque, "kQ", number, section.plots);
  if (file.curve) section.plots.push_back(curve_plot(*file.curve, number));
  return section;
}

}  // namespace ident
