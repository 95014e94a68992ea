// Pairs measured and simulated samples and draws what is between them.
#include "ident/views/simulation_residuals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ident/plots/residual_plots.h"
#include "ident/plots/spectrum_plot.h"

namespace ident {
namespace {

// The channels that tell most about moments and thrust; the others are their integrals.
constexpr std::array<std::string_view, 4> kChannels{"p", "q", "r", "az"};

const Series* find_style(const Plot& plot, Series::Style style) {
  const auto at = std::ranges::find(plot.series, style, &Series::style);
  return at == plot.series.end() ? nullptr : &*at;
}

/// "p" and "rad/s" of the label "p [rad/s]".
ResidualNames names_of(const Plot& plot) {
  const std::string& label = plot.y_label;
  const std::size_t open = label.find(" ["), close = label.rfind(']');
  if (open == std::string::npos || close == std::string::npos) return {.channel = label, .unit = "-"};
  return {.channel = label.substr(0, open), .unit = label.substr(open + 2, close - open - 2)};
}

std::vector<double> standardized(const std::vector<double>& residual) {
  double sum = 0.0;
  for (const double r : residual) sum += r * r;
  const double rms = std::sqrt(sum / static_cast<double>(residual.size()));
  std::vector<double> out = residual;
  for (double& r : out) r /= std::max(rms, 1e-300);
  return out;
}

double median_step(const std::vector<double>& t) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  std::ranges::nth_element(steps, steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2));
  return steps[steps.size() / 2];
}

void add_channel(Section& section, const Plot& plot) {
  const Series *measured = find_style(plot, Series::Style::measured),
               *simulated = find_style(plot, Series::Style::predicted);
  if (measured == nullptr || simulated == nullptr || measured->y.size() != simulated->y.size()) return;
  if (measured->y.size() < 32) return;
  ResidualNames names = names_of(plot);
  if (std::ranges::find(kChannels, names.channel) == kChannels.end()) return;
  names.id = "simulation-" + names.channel;
  std::vector<double> residual = measured->y;
  for (std::size_t i = 0; i < residual.size(); ++i) residual[i] -= simulated->y[i];
  const std::vector<double> scaled = standardized(residual);
  const std::vector<bool> none_rejected(residual.size(), false);
  section.plots.push_back(residual_plot(names, measured->x, "time [s]", residual, none_rejected));
  section.plots.push_back(residual_plot(names, simulated->y, plot.y_label, residual, none_rejected));
  section.plots.push_back(normal_quantile_plot(names, scaled));
  section.plots.push_back(autocorrelation_plot(names, residual));
  section.plots.push_back(spectrum_plot(names, residual, median_step(measured->x)));
}

}  // namespace

Section simulation_residuals(const Section& verification) {
  Section section{
      .title = "What the simulation leaves over",
      .text =
          "Measured minus simulated, in the windows above. White where the model is right up to the "
          "noise of the sensors; what is slow is what the model lacks, or gusts."};
  for (const Plot& plot : verification.plots) add_channel(section, plot);
  return section;
}

}  // namespace ident
