// Whether one model predicts worse than another beyond chance, window by window.
#pragma once

#include "ident/flight/ladder/held_out_errors.h"

namespace ident {

/// Whether errors `a` are greater than errors `b` of the same windows by more than chance: over blocks
/// of flight, whose windows hang together, at that level: by t tests on one side of the differences of
/// squared errors, which show harm in a few places, and of the logarithms of their ratios, which show it
/// where errors differ much from place to place. With too few
/// blocks for that, by more than a quarter.
bool worse_beyond_chance(const std::vector<WindowErrors>& a, const std::vector<WindowErrors>& b,
                         Metric metric, std::size_t horizon, double level);

}  // namespace ident
