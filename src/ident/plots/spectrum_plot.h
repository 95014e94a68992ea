// Spectrum of residuals, with the band in which white noise of the same power would lie.
#pragma once

#include <span>
#include <vector>

#include "ident/plots/residual_plots.h"

namespace ident {

/// One-sided power density by Welch's method: segments of at most 512 samples, half overlapping, Hann window.
struct Spectrum {
  std::vector<double> frequency;  ///< Hz, without zero
  std::vector<double> density;    ///< unit^2/Hz; its integral is the variance
  double white = 0.0;             ///< density of white noise of the same variance
  double low = 0.0, high = 0.0;   ///< 95 % of the densities of such noise lie between `low` and `high`
};

/// `interval` is the time between two samples, s. A sample that is not finite counts as zero.
Spectrum spectrum_of(std::span<const double> residual, double interval);

Plot spectrum_plot(const ResidualNames& names, std::span<const double> residual, double interval);

}  // namespace ident
