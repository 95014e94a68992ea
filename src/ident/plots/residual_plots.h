// Pictures of what a fit left over: residuals, their distribution, their autocorrelation.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/result/result.h"

namespace ident {

/// What the residuals of one channel are called in the pictures: id is part of the plots' ids.
struct ResidualNames {
  std::string id, channel, unit;
};

/// Residuals over something; `x_label` carries the unit. Points left out of the fit have a series of their
/// own.
Plot residual_plot(const ResidualNames& names, std::span<const double> x, const std::string& x_label,
                   std::span<const double> residual, const std::vector<bool>& rejected);

/// Ordered standardised residuals against the normal distribution. NaN is left out.
Plot normal_quantile_plot(const ResidualNames& names, std::span<const double> standardized);

/// Histogram of standardised residuals with the normal density.
Plot histogram_plot(const ResidualNames& names, std::span<const double> standardized);

/// Autocorrelation of the raw residuals and, where there are any, of the decorrelated ones, with the 95 %
/// band of white noise.
Plot autocorrelation_plot(const ResidualNames& names, std::span<const double> residual,
                          std::span<const double> standardized = {});

}  // namespace ident
