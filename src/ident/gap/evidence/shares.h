// How the gap is shared out among the causes found, and what is left: Shapley values on held-out flight.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/evidence/held_out_gap.h"

namespace ident {

/// A share of the gap with its 95 % interval; NaN where the model as given misses no more than the floor.
struct Share {
  double value = kNaN;
  std::array<double, 2> ci95{kNaN, kNaN};
};

struct CauseShare {
  std::string name;
  Share share;
};

/// Shares of `before` less the floor; those of the causes and `remaining` add up to 1.
struct GapShares {
  double before = kNaN, after = kNaN, floor = kNaN;  ///< root mean squares over sensor noise
  std::vector<CauseShare> causes;                    ///< by name, as names_of() gives them
  Share remaining;
};

/// Over the held-out windows of the judged horizon.
GapShares gap_shares(const HeldOutGap& all, const SearchResult& search);

/// What each of `errors.size()` = 2^k sets of k causes misses (bit c: cause c is in the set; set 0 is the
/// model as given), shared out: the mean, over all orders of taking causes up, of what a cause takes away.
std::vector<double> shapley_values(const std::vector<double>& errors);

}  // namespace ident
