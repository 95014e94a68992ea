// The rotor speed of a thrust sweep: which column to trust, spikes taken out, gaps filled.
#pragma once

#include <vector>

#include "ident/data/table.h"

namespace ident {

/// Rotor speed in every row of a table, rad/s; NaN where nothing is known.
struct SweepSpeed {
  std::vector<double> Omega;
  std::string column;  ///< header that it was taken from
};

/// The column that `speed_column` trusts. Throws DataError, saying what each column holds, when none is
/// usable.
SweepSpeed sweep_speed(const NumberTable& table, std::vector<Warning>& warnings);

/// Replaces single samples that stand out of a running median by more than `least`, and counts them. For logs
/// that are much faster than the speed changes.
std::size_t remove_speed_spikes(std::vector<double>& Omega, double least);

/// Linear in `place` between the samples around a gap of at most `longest`; ends stay as they are. Returns
/// how many were filled.
std::size_t fill_gaps(std::vector<double>& values, const std::vector<double>& place, double longest);

}  // namespace ident
