// Takes a known low-pass of the maker back out of a signal.
#pragma once

#include <vector>

namespace ident {

/// A signal behind a Butterworth low-pass of second order (LowPassFilter2p of PX4, ArduPilot and the
/// Crazyflie): y + sqrt(2)/w y' + y''/w^2, w = 2 pi `cutoff` Hz, is what went in. Derivatives are those of
/// parabolas through the samples about each, wide enough for three times the cutoff: beyond that noise would
/// be all. A sample next to a hole in the time becomes NaN. Signals that were sampled too seldom for
/// derivatives keep their values, and `t` moves to when they were, by the filter's delay sqrt(2)/w. Returns
/// whether derivatives were taken.
bool undo_low_pass(std::vector<double>& t, std::vector<double>& values, double cutoff);

}  // namespace ident
