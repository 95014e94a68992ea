// The verdict of a search that found no cause.
#pragma once

#include <vector>

#include "ident/flight/fit/prediction.h"
#include "ident/gap/statistics/bursts.h"
#include "ident/gap/statistics/generic_rival.h"
#include "ident/gap/statistics/spectral_line.h"
#include "ident/gap/verdict/verdict.h"
#include "ident/result/result.h"

namespace ident {

/// A generic rival that gains this much on held-out flight, with no cause found, has seen something.
inline constexpr double kRivalGain = 45.0;

/// What still says that something is there, as `unknown`, else `none`. What strikes a vehicle does not only
/// turn it about its yaw axis: that is what gusts do by a drag that the rotors do not share alike.
Judged nothing_found(const GapClosed& gap, const Rival& rival, const std::vector<SpectralLine>& lines,
                     const std::vector<Burst>& jumps, const std::vector<Parameter>& fitted);

}  // namespace ident
