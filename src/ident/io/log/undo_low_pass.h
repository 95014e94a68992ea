// Takes a known low-pass of the maker back out of a signal.
#pragma once

#include <vector>

#include "ident/data/low_pass.h"

namespace ident {

/// A signal before a low-pass. Derivatives are those of polynomials through the samples about each, wide
/// enough for three times the corner: beyond that noise would be all. A sample next to a hole in the time
/// becomes NaN. Signals that were sampled too seldom for derivatives keep their values, and `t` moves to when
/// they were, by the lag. Returns whether derivatives were taken.
bool undo_low_pass(std::vector<double>& t, std::vector<double>& values, const LowPass& filter);

}  // namespace ident
