// Whether one model predicts worse than another beyond chance, window by window.
#pragma once

#include "ident/flight/ladder/held_out_errors.h"

namespace ident {

/// Whether errors `a` are greater than errors `b` of the same windows by more than chance: by a t test of the
/// differences over blocks of flight, whose windows hang together, on one side at that level. With too few
/// blocks for that, by more than a quarter.
bool worse_beyond_chance(const std::vector<WindowErrors>& a, const std::vector<WindowErrors>& b,
                         Metric metric, std::size_t horizon, double level);

}  // namespace ident
