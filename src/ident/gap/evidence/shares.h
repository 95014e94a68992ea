// How the gap is shared out among the causes found, and what is left: Shapley values on held-out flight.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/evidence/held_out_gap.h"

namespace ident {

/// A share of the gap with its 95 % interval; NaN where the model without causes misses no more than the
/// floor.
struct Share {
  double value = kNaN;
  std::array<double, 2> ci95{kNaN, kNaN};
};

struct CauseShare {
  std::string name;
  Share share;
};

/// Shares of what the model with the constants found, and without any cause, misses beyond the floor; those
/// of the causes and `remaining` add up to 1. What the constants close, refitted within what was stated of
/// them, is no cause's: it is left out on both sides.
struct GapShares {
  double without_causes = kNaN;    ///< root mean square of that model's error over sensor noise
  std::vector<CauseShare> causes;  ///< by name, as names_of() gives them
  Share remaining;
};

/// Share of the gap that constants close, refitted within what was stated of them; 0 where there is no gap.
double closed_by_constants(const GapShares& shares, const GapClosed& gap);

/// Sums over the windows of a block of flight: the square of what each of 2^k sets of k causes misses, and of
/// what a perfect model would.
struct BlockErrors {
  std::vector<double> errors;
  double floor = 0, windows = 0;
};

/// Shares of the causes `names`, with intervals by drawing blocks.
GapShares share_out(const std::vector<std::string>& names, const std::vector<BlockErrors>& blocks);

/// Over the held-out windows of the judged horizon.
GapShares gap_shares(const HeldOutGap& all, const SearchResult& search);

/// What each of `errors.size()` = 2^k sets of k causes misses (bit c: cause c is in the set), shared
/// out: the mean, over all orders of taking causes up, of what a cause takes away.
std::vector<double> shapley_values(const std::vector<double>& errors);

}  // namespace ident
