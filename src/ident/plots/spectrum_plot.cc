// Welch's method.
#include "ident/plots/spectrum_plot.h"

#include <algorithm>
#include <cmath>

#include "ident/core/periodograms.h"

namespace ident {
namespace {

constexpr std::size_t kLongest = 512;  // samples in a segment
// Hann windows that overlap by half share a sixth of their squared weight: so many segments are worth one
// less.
constexpr double kIndependent = 9.0 / 11.0;

/// Quantile of a chi-squared variable over its degrees of freedom, by Wilson and Hilferty; `z` of the normal.
double chi_squared_share(double degrees, double z) {
  const double spread = 2.0 / (9.0 * degrees);
  return std::pow(std::max(0.0, 1.0 - spread + z * std::sqrt(spread)), 3.0);
}

}  // namespace

Spectrum spectrum_of(std::span<const double> residual, double interval) {
  Spectrum out;
  std::vector<double> y(residual.begin(), residual.end());
  double power = 0.0;
  for (double& v : y) v = std::isfinite(v) ? v : 0.0, power += v * v;
  const std::size_t length = std::min(kLongest, y.size());
  if (length < 16 || !(interval > 0.0)) return out;
  Periodograms stretches(length);
  for (std::size_t start = 0; start + length <= y.size(); start += length / 2)
    stretches.add(std::span(y).subspan(start, length), 0.0);
  for (std::size_t f = 1; f <= length / 2; ++f) {
    out.frequency.push_back(static_cast<double>(f) / (static_cast<double>(length) * interval));
    out.density.push_back(2.0 * interval * stretches.power()[f] / (stretches.weight() * stretches.count()));
  }
  const double degrees = 2.0 * std::max(1.0, kIndependent * stretches.count());
  out.white = 2.0 * interval * power / static_cast<double>(y.size());
  out.low = out.white * chi_squared_share(degrees, -1.96);
  out.high = out.white * chi_squared_share(degrees, 1.96);
  return out;
}

Plot spectrum_plot(const ResidualNames& names, std::span<const double> residual, double interval) {
  const Spectrum s = spectrum_of(residual, interval);
  Series band{.name = "white noise, 95 %", .style = Series::Style::band};
  if (!s.frequency.empty())
    band.x = {s.frequency.front(), s.frequency.back()}, band.y = {s.low, s.low}, band.y2 = {s.high, s.high};
  return {
      .id = names.id + "-spectrum",
      .title = "Spectrum of the residuals of " + names.channel,
      .caption = "Power above the band at a frequency is what the model does not explain there.",
      .x_label = "frequency [Hz]",
      .y_label = "density [(" + names.unit + ")^2/Hz]",
      .log_x = true,
      .log_y = true,
      .series = {std::move(band), {.name = names.channel + " residual", .x = s.frequency, .y = s.density}}};
}

}  // namespace ident
