// Residual pictures as data.
#include "ident/plots/residual_plots.h"

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kInSight =
    20.0;  // times what is kept: a reading left out that is larger would hide all else

using Style = Series::Style;

std::vector<double> sorted_finite(std::span<const double> x) {
  std::vector<double> kept;
  std::ranges::copy_if(x, std::back_inserter(kept), [](double v) { return std::isfinite(v); });
  std::ranges::sort(kept);
  return kept;
}

std::vector<double> one_to(std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = static_cast<double>(i + 1);
  return x;
}

}  // namespace

Plot residual_plot(const ResidualNames& names, std::span<const double> x, const std::string& x_label,
                   std::span<const double> residual, const std::vector<bool>& rejected) {
  Plot plot{.id = names.id + "-over-" + x_label.substr(0, x_label.find(' ')),
            .title = "Residual of " + names.channel + " over " + x_label,
            .caption = "Measured minus fitted. Without structure where the model is right.",
            .x_label = x_label,
            .y_label = names.channel + " residual [" + names.unit + "]"};
  Series kept{.name = names.channel + " residual", .style = Style::points};
  Series out{.name = "left out", .style = Style::points};
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!rejected[i] && std::isfinite(residual[i])) largest = std::max(largest, std::abs(residual[i]));
  int beyond = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (rejected[i] && std::abs(residual[i]) > kInSight * largest) {
      ++beyond;
      continue;
    }
    Series& series = rejected[i] ? out : kept;
    series.x.push_back(x[i]);
    series.y.push_back(residual[i]);
  }
  if (beyond > 0) plot.caption += " Beyond the picture, left out: " + std::to_string(beyond) + ".";
  plot.series.push_back(std::move(kept));
  if (!out.x.empty()) plot.series.push_back(std::move(out));
  return plot;
}

Plot normal_quantile_plot(const ResidualNames& names, std::span<const double> standardized) {
  const std::vector<double> y = sorted_finite(standardized);
  Series points{.name = names.channel + " residual", .y = y, .style = Style::points};
  for (std::size_t i = 0; i < y.size(); ++i)
    points.x.push_back(normal_quantile((static_cast<double>(i) + 0.5) / static_cast<double>(y.size())));
  Series line{.name = "normal", .style = Style::line};
  if (!y.empty()) line.x = line.y = {points.x.front(), points.x.back()};
  return {.id = names.id + "-normal",
          .title = "Residuals of " + names.channel + " against the normal distribution",
          .caption = "On the line where the noise is normal and its level and colour are right.",
          .x_label = "normal quantile [-]",
          .y_label = "standardised residual [-]",
          .series = {std::move(points), std::move(line)}};
}

Plot histogram_plot(const ResidualNames& names, std::span<const double> standardized) {
  const std::vector<double> y = sorted_finite(standardized);
  const auto n = static_cast<double>(y.size());
  constexpr double reach = 4.0;
  const std::size_t bins = std::clamp<std::size_t>(static_cast<std::size_t>(2.0 * std::cbrt(n)) + 1, 7, 41);
  const double width = 2.0 * reach / static_cast<double>(bins);
  Series bars{.name = names.channel + " residual", .style = Style::bars};
  Series density{.name = "normal", .style = Style::line};
  for (std::size_t b = 0; b < bins; ++b) {
    const double low = -reach + width * static_cast<double>(b);
    const auto count = std::ranges::lower_bound(y, low + width) - std::ranges::lower_bound(y, low);
    bars.x.push_back(low + 0.5 * width);
    bars.y.push_back(n > 0 ? static_cast<double>(count) / (n * width) : 0.0);
  }
  for (double z = -reach; z <= reach + 1e-9; z += 0.1) {
    density.x.push_back(z);
    density.y.push_back(std::exp(-0.5 * z * z) / std::sqrt(2.0 * M_PI));
  }
  return {.id = names.id + "-histogram",
          .title = "Distribution of the residuals of " + names.channel,
          .x_label = "standardised residual [-]",
          .y_label = "density [-]",
          .series = {std::move(bars), std::move(density)}};
}

Plot autocorrelation_plot(const ResidualNames& names, std::span<const double> residual,
                          std::span<const double> standardized) {
  const std::size_t lags = std::min<std::size_t>(40, residual.size() / 4);
  const auto after_first = [](std::vector<double> r) {
    if (!r.empty()) r.erase(r.begin());
    return r;
  };
  const double edge = 1.96 / std::sqrt(static_cast<double>(std::max<std::size_t>(1, residual.size())));
  std::vector<double> kept(residual.begin(), residual.end());
  for (std::size_t i = 0; i < kept.size() && standardized.size() == kept.size(); ++i)
    if (std::isnan(standardized[i])) kept[i] = kNaN;  // an outlier
  const std::vector<double> raw = after_first(autocorrelation(kept, lags));
  Series band{.name = "white noise, 95 %",
              .x = one_to(raw.size()),
              .y = std::vector<double>(raw.size(), -edge),
              .y2 = std::vector<double>(raw.size(), edge),
              .style = Style::band};
  Plot plot{.id = names.id + "-autocorrelation",
            .title = "Autocorrelation of the residuals of " + names.channel,
            .x_label = "lag [samples]",
            .y_label = "autocorrelation [-]",
            .series = {std::move(band),
                       {.name = "as they are", .x = one_to(raw.size()), .y = raw, .style = Style::bars}}};
  if (standardized.empty()) return plot;
  const std::vector<double> white = after_first(autocorrelation(standardized, lags));
  plot.caption = "Decorrelated residuals leave the band where the model of the noise is wrong.";
  plot.series.push_back(
      {.name = "decorrelated", .x = one_to(white.size()), .y = white, .style = Style::points});
  return plot;
}

}  // namespace ident
