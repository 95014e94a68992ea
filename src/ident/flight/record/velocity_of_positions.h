// The velocity that positions show where none was logged.
//
// A parabola is fitted to the samples within +-h of each instant. With noise sigma, D s between samples and a
// jerk j its slope has the error
//
//   sqrt(3 sigma^2 D/(2 h^3)) by noise,   j h^2/10 by what a parabola cannot follow,
//
// which are alike at h = (150 sigma^2 D/j^2)^(1/7).
#pragma once

#include <span>
#include <vector>

namespace ident {

/// At the instants `t`, from samples y (NaN: none) with white noise `sigma`; 0 with fewer than two of them.
std::vector<double> velocity_of_positions(const std::vector<double>& t, std::span<const double> y,
                                          double sigma);

}  // namespace ident
