// Whether one model predicts worse than another beyond chance, window by window.
#pragma once

#include "ident/flight/ladder/held_out_errors.h"

namespace ident {

/// Whether errors `a` are greater than errors `b` of the same windows by more than chance, at that level. Two
/// one-sided t tests share the level; each takes the sums over blocks of flight, within which windows hang
/// together. Differences of squared errors show harm in a few places. Logarithms of their ratios show it
/// where errors differ much from place to place.
bool worse_beyond_chance(const std::vector<WindowErrors>& a, const std::vector<WindowErrors>& b,
                         Metric metric, std::size_t horizon, double level);

}  // namespace ident
